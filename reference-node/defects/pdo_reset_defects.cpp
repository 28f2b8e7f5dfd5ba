// SPDX-License-Identifier: Apache-2.0
// Defects of PDOs that keep over a reset what was configured before: the objects have their power-on values
// again, and the service works as it did.
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "defects/cob_ids.hpp"
#include "defects/pdos.hpp"
#include "defects/receivers.hpp"

namespace refnode {

using namespace defect;

namespace {

/// The value that was written last, or the present one of a PDO that was never configured.
template <typename Value>
Value kept(const std::map<std::uint16_t, std::uint64_t>& written, const PdoParameters& pdo, Value present) {
  const auto found = written.find(pdo.number());
  return found == written.end() ? present : static_cast<Value>(found->second);
}

/// The values of the mapping are read when its count is written.
Change keeps_the_mapping(PdoRulesPart of, std::uint16_t first) {
  return [of, first](Parts& parts) {
    const auto cached = std::make_shared<std::map<std::uint16_t, std::vector<Mapped>>>();
    for (std::uint16_t number = 0; number <= last_pdo; ++number) {
      const auto mapping = static_cast<std::uint16_t>(first + number);
      after_writing(mapping, 0, [=](Parts& node, const std::function<void()>& former) {
        const ObjectDictionary& od = node.device.dictionary;
        auto& entries = (*cached)[number];
        entries.clear();
        for (std::uint8_t sub = 1; sub <= od.number(mapping, 0) && sub <= most_mapped; ++sub)
          entries.push_back(Mapped::unpack(od.number(mapping, sub)));
        former();
      })(parts);
    }
    of(parts).mapping.replace(
        [cached](const auto& former, const PdoParameters& pdo, const std::vector<Mapped>& counted) {
          const auto found = cached->find(pdo.number());
          return former(pdo, found == cached->end() ? counted : found->second);
        });
  };
}

/// The event timer is set by its write, and by no reset.
Change keeps_the_event_timer(PdoRulesPart of, std::uint16_t first) {
  return [of, first](Parts& parts) {
    const auto written = written_ever(parts, first, 5);
    of(parts).event_timer.replace(
        [written](const auto& former, const PdoParameters& pdo, std::int64_t value) {
          return former(pdo, kept(*written, pdo, value));
        });
  };
}

/// The event timers of TPDOs that a reset finds in Operational go on until the next NMT command.
void timers_outlive_operational(Parts& parts) {
  const auto was_operational = std::make_shared<bool>(false);
  const auto written = written_ever(parts, 0x1800, 5);
  deaf_to([was_operational](Parts& node, const Frame& frame) {
    if (is_nmt_command(frame) && is_for(node, frame))
      *was_operational = frame.data[0] > 0x80 && node.device.state == NmtState::operational;
    return false;
  })(parts);
  parts.device.works.replace([was_operational](const auto& former, Service service, NmtState state) {
    return former(service, state) ||
           (*was_operational && service == Service::tpdo && state == NmtState::pre_operational);
  });
  parts.pdos.tpdo.parameters.rules.event_timer.replace(
      [=](const auto& former, const PdoParameters& pdo, std::int64_t value) {
        return former(pdo, *was_operational ? kept(*written, pdo, value) : value);
      });
}

/// What bit 31 of the COB-ID was last written as decides.
template <typename Rules>
Change stays_off(Rules& (*part)(Parts&), std::uint16_t first) {
  return [part, first](Parts& parts) {
    const auto written = written_ever(parts, first, 1);
    part(parts).valid.replace([written](const auto& former, const PdoParameters& pdo) {
      return (kept<std::uint64_t>(*written, pdo, 0) & 0x8000'0000U) == 0 && former(pdo);
    });
  };
}

/// The CAN-ID that the controller was told when the COB-ID was written.
void keeps_the_can_ids_of_tpdos(Parts& parts) {
  const auto written = written_ever(parts, 0x1800, 1);
  parts.device.outbox.add_filter(
      [&parts, written](const FilterContext& context, std::vector<Outgoing>& frames) {
        if (context.service != Service::tpdo) return;
        for (Outgoing& each : frames) {
          for (const auto& [number, cob_id] : *written) {
            const auto index = static_cast<std::uint16_t>(0x1800 + number);
            const auto present = parts.device.dictionary.number(index, 1);
            if ((present & can_id_bits) != each.frame.id) continue;
            each.frame.id = static_cast<std::uint32_t>(cob_id & can_id_bits);
            break;
          }
        }
      });
}

void keeps_the_can_ids_of_rpdos(Parts& parts) {
  const auto written = written_ever(parts, 0x1400, 1);
  misreads([written](Parts& node, Frame& frame) {
    constexpr std::uint32_t nobodys = 0x7FF;
    if (frame.extended || frame.remote) return;
    for (const auto& [number, cob_id] : *written) {
      const auto index = static_cast<std::uint16_t>(0x1400 + number);
      const auto present = node.device.dictionary.number(index, 1) & can_id_bits;
      const auto kept_id = cob_id & can_id_bits;
      if (present == kept_id) continue;
      if (frame.id == kept_id) {
        frame.id = static_cast<std::uint32_t>(present);
        return;
      }
      if (frame.id == present) {
        frame.id = nobodys;
        return;
      }
    }
  })(parts);
}

/// The way of the type that was written last.
void keeps_the_types_of_rpdos(Parts& parts) {
  const auto written = written_ever(parts, 0x1400, 2);
  parts.pdos.rpdo.rules.waits_for_sync.replace([written](const auto& former, const PdoParameters& pdo) {
    const auto found = written->find(pdo.number());
    return found == written->end() ? former(pdo) : is_synchronous(found->second);
  });
}

}  // namespace

DefectTable pdo_reset_defects() {
  return {
      {"rpdo-mapping-in-use-outlives-reset",
       "Behind reset communication an RPDO is received with the mapping that was written before",
       {"NMT-FSA-24"},
       keeps_the_mapping(rpdo_parameters, 0x1600)},
      {"tpdo-mapping-in-use-outlives-reset",
       "Behind reset communication a TPDO is sent with the mapping that was written before",
       {"NMT-FSA-24", "PDO-TX-01"},
       keeps_the_mapping(tpdo_parameters, 0x1A00)},
      {"rpdo-switched-off-outlives-reset",
       "An RPDO that was switched off is not received behind reset communication",
       {"NMT-FSA-24"},
       stays_off(rpdo_traffic, 0x1400)},
      {"tpdo-switched-off-outlives-reset",
       "A TPDO that was switched off is not sent behind reset communication",
       {"NMT-FSA-24"},
       stays_off(tpdo_traffic, 0x1800)},
      {"rpdo-can-id-in-use-outlives-reset",
       "Behind reset communication an RPDO is received with the CAN-ID that was written before",
       {"NMT-FSA-24"},
       Change(keeps_the_can_ids_of_rpdos)},
      {"tpdo-can-id-in-use-outlives-reset",
       "Behind reset communication a TPDO is sent with the CAN-ID that was written before",
       {"NMT-FSA-24"},
       Change(keeps_the_can_ids_of_tpdos)},
      {"rpdo-type-in-use-outlives-reset",
       "Behind reset communication an RPDO takes effect as the type says that was written before",
       {"NMT-FSA-24", "PDO-RX-01"},
       Change(keeps_the_types_of_rpdos)},
      {"tpdo-event-timer-in-use-outlives-reset",
       "Behind reset communication the event timer of a TPDO runs that was written before",
       {"NMT-FSA-24"},
       keeps_the_event_timer(tpdo_parameters, 0x1800)},
      {"tpdo-goes-on-behind-a-reset-in-operational",
       "The event timer of a TPDO goes on in Pre-operational behind a reset in Operational",
       {"PDO-TX-02"},
       Change(timers_outlive_operational)},
      {"rpdo-deadline-in-use-outlives-reset",
       "Behind reset communication the deadline of an RPDO is watched that was written before",
       {"NMT-FSA-24"},
       keeps_the_event_timer(rpdo_parameters, 0x1400)},
  };
}

}  // namespace refnode
