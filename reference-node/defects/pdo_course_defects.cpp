// SPDX-License-Identifier: Apache-2.0
// Defects of PDOs that show in what follows only: what a received PDO does to the process, what a parameter
// leaves behind, what a long count of SYNCs brings.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "defects/pdos.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr std::uint32_t sync_can_id = 0x080;

/// CAN-IDs that the pre-defined connection set gives to RPDOs: function codes 4, 6, 8 and 10.
bool is_rpdo(const Frame& frame) {
  const auto function = frame.id >> 7U;
  return function == 4 || function == 6 || function == 8 || function == 10;
}

/// Whether what is written now was brought by an RPDO, at once or with a SYNC.
std::shared_ptr<bool> brought_by_rpdo(Parts& parts) {
  auto answer = std::make_shared<bool>(false);
  misreads([answer](Parts&, Frame& frame) { *answer = is_rpdo(frame) || frame.id == sync_can_id; })(parts);
  return answer;
}

void leaves_outputs_alone(Parts& parts) {
  const auto by_rpdo = brought_by_rpdo(parts);
  for (const std::uint16_t outputs : std::to_array<std::uint16_t>({0x6200, 0x6411, 0x6412})) {
    after_writing_all(outputs, [by_rpdo](Parts&, const std::function<void()>& former, std::uint8_t) {
      if (!*by_rpdo) former();
    })(parts);
  }
}

void sees_no_change_by_rpdo(Parts& parts) {
  const auto by_rpdo = brought_by_rpdo(parts);
  parts.pdos.tpdo.rules.is_event.replace(
      [by_rpdo](const auto& former, const PdoParameters& pdo, const Bytes& sent, const Bytes& now) {
        return !*by_rpdo && former(pdo, sent, now);
      });
}

/// What was taken with a SYNC comes once more before each that follows, until another RPDO comes.
void takes_again_with_sync(Parts& parts) {
  const auto taken = std::make_shared<bool>(false);
  parts.pdos.rpdo.rules.taken_at_sync.replace(
      [taken](const auto& former, const PdoParameters& pdo, const Bytes& waiting) {
        *taken = true;
        return former(pdo, waiting);
      });
  misreads([taken, last = std::make_shared<std::optional<Frame>>()](Parts& node, Frame& frame) {
    if (is_rpdo(frame)) {
      *last = frame;
      *taken = false;
    }
    if (frame.id == sync_can_id && *taken && *last) node.pdos.on_frame(**last);
  })(parts);
}

/// Type FCh: before the first SYNC since it was written there is nothing that was sampled, and nothing is
/// sent.
void empty_before_sync(Parts& parts) {
  const auto sampled = std::make_shared<std::set<std::uint16_t>>();
  auto& rules = parts.pdos.tpdo.rules;
  rules.takes_effect.replace([sampled](const auto& former, const PdoParameters& pdo) {
    sampled->erase(pdo.number());
    return former(pdo);
  });
  rules.sent_at_sync.replace(
      [sampled](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        sampled->insert(pdo.number());
        return former(pdo, syncs, event);
      });
  rules.carried.replace([sampled](const auto& former, const PdoParameters& pdo, const Bytes& due) -> Bytes {
    const bool early = pdo.transmission_type() == remote_synchronous_type && !sampled->contains(pdo.number());
    return early ? Bytes{} : former(pdo, due);
  });
}

Change maps_one_bit_of_anything(PdoRulesPart of) {
  return decides(of, &PdoRules::mappable, [](const auto& former, const Mapped& mapped) {
    return mapped.bits == 1 ? Accepted{} : former(mapped);
  });
}

}  // namespace

DefectTable pdo_course_defects() {
  return {
      {"rpdo-outputs-left-alone",
       "What an RPDO brings is written to the object, and does not reach the output",
       {"PDO-RX-01"},
       Change(leaves_outputs_alone)},
      {"tpdo-change-by-rpdo-ignored",
       "A change that an RPDO makes is no event of a TPDO",
       {"PDO-TX-08"},
       Change(sees_no_change_by_rpdo)},
      {"rpdo-taken-again-with-every-sync",
       "A synchronous RPDO takes effect with each SYNC that follows",
       {"PDO-RX-03"},
       Change(takes_again_with_sync)},
      {"rpdo-deadline-not-switched-off",
       "Event timer 0 of an RPDO leaves the former time in force",
       {"PDO-RX-15"},
       decides_by<std::map<std::uint16_t, std::int64_t>>(
           rpdo_parameters, &PdoRules::event_timer,
           [](auto& before, const auto& former, const PdoParameters& pdo, std::int64_t value) {
             if (value != 0) before[pdo.number()] = value;
             return former(pdo, before[pdo.number()]);
           })},
      {"tpdo-type-fch-empty-before-sync",
       "A TPDO of type FCh answers a remote frame before the first SYNC without data",
       {"PDO-TX-01"},
       Change(empty_before_sync)},
      {"tpdo-type-fdh-sent-after-253-syncs",
       "A TPDO of type FDh is sent with every 253rd SYNC",
       {"PDO-TX-19"},
       decides(tpdo_traffic, &TransmitPdoRules::sent_at_sync,
               [](const auto& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
                 const bool counted =
                     pdo.transmission_type() == remote_event_driven_type && syncs >= remote_event_driven_type;
                 return counted || former(pdo, syncs, event);
               })},
      {"1600-single-bit-of-anything",
       "One bit of any object, also of an absent one, can be mapped to an RPDO",
       {"OD-1600-06", "PDO-MAP-18"},
       maps_one_bit_of_anything(rpdo_parameters)},
      {"1a00-single-bit-of-anything",
       "One bit of any object, also of an absent one, can be mapped to a TPDO",
       {"OD-1A00-06", "PDO-MAP-18"},
       maps_one_bit_of_anything(tpdo_parameters)},
  };
}

}  // namespace refnode
