// SPDX-License-Identifier: Apache-2.0
// Defects of TPDOs that show only in some mapping, or only in a configuration that nobody tests on purpose.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include "defects/hooks.hpp"
#include "defects/pdos.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr std::uint32_t invalid = 0x8000'0000U;  // bit 31 of a COB-ID

TransmitPdoRules& traffic(Parts& parts) { return parts.pdos.tpdo.rules; }

/// The event timer of a TPDO that is not valid sends on, with the CAN-ID that is left of its COB-ID.
Change event_timer_sends_on_000h() {
  return together(
      decides(traffic, &TransmitPdoRules::valid,
              [](const auto& former, const PdoParameters& pdo) {
                const bool timed =
                    is_event_driven(pdo.transmission_type()) && pdo.event_timer() > Duration::zero();
                return timed || former(pdo);
              }),
      [](Parts& parts) {
        parts.device.outbox.add_filter([&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
          if (context.service != Service::tpdo) return;
          const auto cob_id = parts.device.dictionary.number(0x1800, 1);
          if ((cob_id & 0x8000'0000U) == 0) return;
          for (Outgoing& outgoing : frames) outgoing.frame.id = 0;
        });
      });
}

/// With NMT start all PDOs are looked at; a valid one that `stops` keeps all of them from working.
Change one_stops_all(bool (*stops)(const ObjectDictionary& od, std::uint16_t communication)) {
  return [stops](Parts& parts) {
    const auto stopped = std::make_shared<bool>(false);
    ahead_of_state_change([stopped, stops](Parts& node) {
      *stopped = false;
      if (node.device.state != NmtState::operational) return;
      const ObjectDictionary& od = node.device.dictionary;
      for (const std::uint16_t first : {std::uint16_t{0x1400}, std::uint16_t{0x1800}}) {
        for (std::uint16_t number = 0; number <= last_pdo; ++number) {
          const auto index = static_cast<std::uint16_t>(first + number);
          const bool valid = (od.number(index, 1, invalid) & invalid) == 0;
          *stopped = *stopped || (valid && stops(od, index));
        }
      }
    })(parts);
    const auto unless_stopped = [stopped](const auto& former, const PdoParameters& pdo) {
      return !*stopped && former(pdo);
    };
    parts.pdos.tpdo.rules.valid.replace(unless_stopped);
    parts.pdos.rpdo.rules.valid.replace(unless_stopped);
  };
}

bool maps_nothing(const ObjectDictionary& od, std::uint16_t communication) {
  return od.number(static_cast<std::uint16_t>(communication + 0x200), 0) == 0;
}

/// It is sent on remote frames only, which bit 30 forbids.
bool can_never_be_asked(const ObjectDictionary& od, std::uint16_t communication) {
  const std::uint64_t type = od.number(communication, 2);
  return (type == 0xFC || type == 0xFD) && (od.number(communication, 1) & 0x4000'0000U) != 0;
}

/// Of the types that `such` tells an answer to a remote frame carries what was never filled in.
Change answers_with_what_was_not_filled_in(bool (*such)(std::uint64_t type)) {
  return [such](Parts& parts) {
    const auto asked = std::make_shared<bool>(false);
    auto& rules = parts.pdos.tpdo.rules;
    rules.answers_remote.replace([asked, such](const auto& former, const PdoParameters& pdo, bool enabled) {
      const bool answers = former(pdo, enabled);
      *asked = answers && such(pdo.transmission_type());
      return answers;
    });
    rules.carried.replace([asked](const auto& former, const PdoParameters& pdo, const Bytes& due) {
      Bytes carried = former(pdo, due);
      if (std::exchange(*asked, false)) std::ranges::fill(carried, std::uint8_t{0xCD});
      return carried;
    });
  };
}

}  // namespace

DefectTable pdo_traffic_defects() {
  return {
      {"1800-invalid-tpdo-on-can-id-0",
       "The event timer of a TPDO that is not valid sends it with CAN-ID 000h, where it is an NMT command",
       {"NMT-SVC-05", "OD-1800-09"},
       event_timer_sends_on_000h()},
      {"pdo-without-objects-stops-all",
       "A valid PDO without mapped objects keeps all PDOs from working",
       {"PDO-TX-05", "PDO-RX-01"},
       one_stops_all(maps_nothing)},
      {"tpdo-never-asked-stops-all",
       "A valid TPDO that is sent on remote frames only, which its COB-ID forbids, keeps all PDOs from working",
       {"PDO-TX-05"},
       one_stops_all(can_never_be_asked)},
      {"tpdo-cyclic-garbage-on-request",
       "The answer of a cyclic TPDO to a remote frame carries data that are nobody's",
       {"PDO-TX-01"},
       answers_with_what_was_not_filled_in(
           [](std::uint64_t type) { return type > 0 && is_synchronous(type); })},
      {"tpdo-event-driven-garbage-on-request",
       "The answer of an event-driven TPDO to a remote frame carries data that are nobody's",
       {"PDO-TX-01"},
       answers_with_what_was_not_filled_in(is_event_driven)},
      {"1800-synchronous-tpdo-too-long",
       "TPDOs of synchronous transmission types have a byte more than is mapped",
       {"PDO-TX-01"},
       Change([](Parts& parts) {
         parts.device.outbox.add_filter(
             [&parts](const FilterContext& context, std::vector<Outgoing>& frames) {
               const bool synchronous = parts.device.dictionary.number(0x1800, 2) <= 240;
               if (context.service != Service::tpdo || !synchronous) return;
               for (Outgoing& outgoing : frames) {
                 if (outgoing.frame.dlc < 8) ++outgoing.frame.dlc;
               }
             });
       })},
  };
}

}  // namespace refnode
