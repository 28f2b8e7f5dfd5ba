// SPDX-License-Identifier: Apache-2.0
// Defects of the error behaviour (1029h) and of the EMCY consumer (1028h).
#include <iterator>

#include "defects/cob_ids.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u16 = DataType::unsigned16;
constexpr DataType u32 = DataType::unsigned32;

/// Every value of the type is taken.
DictionaryEdit without_limits(std::uint16_t index, std::uint8_t sub) {
  return [index, sub](ObjectDictionary& od, std::uint8_t) {
    if (Entry* entry = od.entry(index, sub)) {
      entry->low.reset();
      entry->high.reset();
    }
  };
}

/// After a communication error the node is in `wrong` where 1029h:01 is `class_value` and it was in
/// `present`.
Change reacts(std::uint64_t class_value, NmtState present, NmtState wrong) {
  return [=](Parts& parts) {
    parts.error_behaviour.rules.next_state.replace(
        [=](const auto& former, std::uint64_t value, NmtState state) {
          return value == class_value && state == present ? wrong : former(value, state);
        });
  };
}

DefectTable error_behaviour_rows() {
  return {
      {"1029-sub0-out-of-range", "1029h:00 is 00h", {"OD-1029-01", "OD-GEN-11"}, preset(0x1029, 0, 0)},
      {"1029-sub0-is-u32",
       "1029h:00 has four bytes",
       {"OD-1029-01", "OD-GEN-10", "OD-GEN-17"},
       type(0x1029, 0, u32)},
      {"1029-sub0-writable",
       "1029h:00 can be written",
       {"OD-1029-02", "OD-ACC-02", "SDO-DNL-09"},
       access(0x1029, 0, Access::rw)},
      {"1029-sub1-missing",
       "1029h:01 does not exist",
       {"OD-1029-03", "OD-CAT-02", "OD-GEN-17"},
       absent_sub(0x1029, 1)},
      {"1029-entry-is-u32",
       "1029h:01 has four bytes",
       {"OD-1029-03", "OD-GEN-19", "OD-LEN-04", "OD-GEN-17"},
       type(0x1029, 1, u32)},
      {"1029-default-nonzero", "The default of 1029h:01 is 01h", {"OD-1029-04"}, preset(0x1029, 1, 1)},
      {"1029-not-writable",
       "1029h:01 is read-only",
       {"OD-1029-05", "SDO-DNL-21"},
       access(0x1029, 1, Access::ro)},
      {"1029-not-stored",
       "Writing 1029h:01 is confirmed and forgotten",
       {"OD-1029-05"},
       not_stored(0x1029, 1)},
      {"1029-reserved-value-accepted",
       "1029h:01 takes reserved values",
       {"OD-1029-06", "EC-EB-04"},
       without_limits(0x1029, 1)},
      {"1029-const-writable",
       "1029h:02 can be written although it is constant",
       {"OD-1029-12", "OD-ACC-02"},
       access(0x1029, 2, Access::rw)},
      {"1029-0-goes-to-stopped",
       "With 1029h:01 = 00h a communication error stops the node",
       {"EC-EB-01", "OD-1029-07", "EC-HBC-08", "OD-1029-10"},
       reacts(0, NmtState::operational, NmtState::stopped)},
      {"1029-0-acts-in-stopped",
       "With 1029h:01 = 00h a communication error takes the node from Stopped to Pre-operational",
       {"EC-EB-05", "OD-1029-11"},
       reacts(0, NmtState::stopped, NmtState::pre_operational)},
      {"1029-1-changes-state",
       "With 1029h:01 = 01h a communication error ends Operational",
       {"EC-EB-02", "OD-1029-08"},
       reacts(1, NmtState::operational, NmtState::pre_operational)},
      {"1029-2-not-stopped",
       "With 1029h:01 = 02h a communication error changes nothing",
       {"EC-EB-03", "OD-1029-09"},
       Change([](Parts& parts) {
         parts.error_behaviour.rules.next_state.replace(
             [](const auto& former, std::uint64_t value, NmtState present) {
               return value == 2 ? present : former(value, present);
             });
       })},
  };
}

DefectTable emergency_consumer_rows() {
  return {
      {"1028-sub0-out-of-range", "1028h:00 is 00h", {"OD-1028-01", "OD-GEN-11"}, preset(0x1028, 0, 0)},
      {"1028-sub0-is-u32",
       "1028h:00 has four bytes",
       {"OD-1028-01", "OD-GEN-10", "OD-GEN-17"},
       type(0x1028, 0, u32)},
      {"1028-sub0-writable",
       "1028h:00 can be written",
       {"OD-1028-02", "OD-ACC-02", "SDO-DNL-09"},
       access(0x1028, 0, Access::rw)},
      {"1028-sub1-missing",
       "1028h:01 does not exist",
       {"OD-1028-03", "OD-CAT-02", "OD-GEN-17"},
       absent_sub(0x1028, 1)},
      {"1028-entry-is-u16",
       "1028h:02 has two bytes",
       {"OD-1028-03", "OD-GEN-19", "OD-LEN-04", "OD-GEN-17"},
       type(0x1028, 2, u16)},
      {"1028-reserved-bit30-set",
       "Bit 30 of 1028h:01 is set by default",
       {"OD-1028-04"},
       preset(0x1028, 1, 0xC0000000)},
      {"1028-upper-bits-set",
       "1028h:01 has bits above the CAN-ID set by default",
       {"OD-1028-04"},
       preset(0x1028, 1, 0x80010081)},
      {"1028-frame-bit-accepted",
       "1028h accepts bit 29 although the node knows base frames only",
       {"OD-1028-05"},
       decided(of_emergencies, &CobIdRules::frame_bit_allowed, true)},
      {"1028-frame-bit-wrong-abort",
       "1028h refuses with 0601 0000h instead of 0609 0030h",
       {"OD-1028-05", "OD-1028-06"},
       wrong_abort(abort_code::invalid_value, abort_code::unsupported_access, {0x1028, 0x1028})},
      {"1028-lock-missing",
       "The CAN-ID of a valid entry of 1028h can be changed",
       {"OD-1028-06", "EMCY-CON-01"},
       decided(of_emergencies, &CobIdRules::locked, false)},
      {"1028-change-refused",
       "1028h refuses another CAN-ID even while the entry is not valid",
       {"OD-1028-07"},
       keeps_can_ids(0x1028)},
      {"1028-change-not-stored",
       "Writing 1028h:01 and 1028h:02 is confirmed and forgotten",
       {"OD-1028-07"},
       both(not_stored(0x1028, 1), not_stored(0x1028, 2))},
      {"1028-const-writable",
       "1028h:04 can be written although it is constant",
       {"OD-1028-08", "OD-ACC-02"},
       access(0x1028, 4, Access::rw)},
  };
}

}  // namespace

DefectTable object_defects() {
  DefectTable rows;
  for (DefectTable table : {error_behaviour_rows(), emergency_consumer_rows()}) {
    rows.insert(rows.end(), std::make_move_iterator(table.begin()), std::make_move_iterator(table.end()));
  }
  return rows;
}

}  // namespace refnode
