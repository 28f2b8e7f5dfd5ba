// SPDX-License-Identifier: Apache-2.0
// Defects of TPDOs, parameters (other than COB-IDs) and traffic.
#include <cstdint>

#include "defects/hooks.hpp"
#include "defects/pdos.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u16 = DataType::unsigned16;
constexpr DataType u32 = DataType::unsigned32;

/// A time of the TPDO is another one than it should be.
Change counts(Rule<Duration(const PdoParameters&, std::int64_t)> PdoRules::* time,
              Duration (*as)(Duration right)) {
  return decides(tpdo_parameters, time,
                 [as](const auto& former, const PdoParameters& pdo, std::int64_t value) {
                   return as(former(pdo, value));
                 });
}

using SentAtSync = Rule<bool(const PdoParameters&, std::uint32_t, bool)>::Decision;

Change at_sync(bool (*sent)(const SentAtSync& former, const PdoParameters& pdo, std::uint32_t syncs,
                            bool event)) {
  return decides(tpdo_traffic, &TransmitPdoRules::sent_at_sync, sent);
}

}  // namespace

DefectTable pdo_transmit_defects() {
  return {
      {"1800-absent-for-existing-mapping", "1A00h exists without 1800h", {"OD-1800-03"}, absent(0x1800)},
      {"1a00-absent-for-existing-pdo", "1800h exists without 1A00h", {"OD-1800-03"}, absent(0x1A00)},
      {"1800-sub0-out-of-range", "1800h:00 is 07h", {"OD-1800-01", "OD-GEN-11"}, preset(0x1800, 0, 7)},
      {"1800-sub0-writable",
       "1800h:00 can be written",
       {"OD-1800-02", "SDO-DNL-09"},
       access(0x1800, 0, Access::rw)},
      {"1800-sub2-missing", "1800h:02 does not exist", {"OD-1800-01", "OD-CAT-02"}, absent_sub(0x1800, 2)},
      {"1800-type-is-u16", "1800h:02 has two bytes", {"OD-1800-15", "OD-LEN-04"}, type(0x1800, 2, u16)},
      {"1800-type-not-writable",
       "1800h:02 is read-only in contrast to the description",
       {"OD-1800-15", "SDO-DNL-21"},
       access(0x1800, 2, Access::ro)},
      {"1800-reserved-type-accepted",
       "1800h:02 accepts reserved transmission types",
       {"OD-1800-16", "PDO-TX-17"},
       confirms(0x1800, 2, [](std::uint64_t) { return true; })},
      {"1800-inhibit-lock-missing",
       "1800h:03 can be changed while the TPDO is valid",
       {"OD-1800-18", "PDO-TX-13"},
       unlocked(tpdo_parameters, PdoPart::inhibit_time)},
      {"1800-sub4-is-u32",
       "The reserved 1800h:04 exists with four bytes",
       {"OD-1800-19"},
       extra(0x1800, 4, integer_entry("Reserved", u32, Access::rw, 0))},
      {"1800-event-timer-is-u32",
       "1800h:05 has four bytes",
       {"OD-1800-20", "OD-LEN-04"},
       type(0x1800, 5, u32)},
      {"1800-event-timer-ignored",
       "The event timer of 1800h:05 has no effect",
       {"OD-1800-25", "PDO-TX-09"},
       counts(&PdoRules::event_timer, [](Duration) { return Duration::zero(); })},
      {"1800-event-timer-unit-wrong",
       "1800h:05 counts in units of 10 ms",
       {"OD-1800-25", "PDO-TX-09"},
       counts(&PdoRules::event_timer, [](Duration right) { return right * 10; })},
      {"1800-inhibit-ignored",
       "The inhibit time of 1800h:03 has no effect",
       {"OD-1800-26", "PDO-TX-12"},
       counts(&PdoRules::inhibit_time, [](Duration) { return Duration::zero(); })},
      {"1800-inhibit-unit-10us",
       "1800h:03 counts in units of 10 us",
       {"OD-1800-26", "PDO-TX-12"},
       counts(&PdoRules::inhibit_time, [](Duration right) { return right / 10; })},
      {"1800-cyclic-ratio-wrong",
       "Synchronous TPDOs are sent one SYNC too late",
       {"OD-1800-22", "PDO-TX-05", "PDO-TX-06", "SYNC-CON-01"},
       at_sync([](const SentAtSync& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
         return former(pdo, syncs - 1, event);
       })},
      {"1800-acyclic-sends-every-sync",
       "Transmission type 00h sends with every SYNC",
       {"OD-1800-23", "PDO-TX-07"},
       at_sync([](const SentAtSync& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
         return pdo.transmission_type() == 0 || former(pdo, syncs, event);
       })},
      {"tpdo-change-ignored",
       "A change of a mapped object sends no TPDO",
       {"PDO-TX-08", "PDO-TX-07", "OD-1800-23"},
       Change([](Parts& parts) { parts.pdos.tpdo.choices.change_is_event = false; })},
      {"1800-event-timer-ignores-valid-bit",
       "The event timer sends a TPDO that is not valid",
       {"OD-1800-09"},
       decides(tpdo_traffic, &TransmitPdoRules::valid,
               [](const auto& former, const PdoParameters& pdo) {
                 const bool timed =
                     is_event_driven(pdo.transmission_type()) && pdo.event_timer() > Duration::zero();
                 return timed || former(pdo);
               })},
      {"1800-rtr-type-sends-unasked",
       "Transmission type FCh sends with the SYNC",
       {"OD-1800-24", "PDO-TX-20"},
       at_sync([](const SentAtSync& former, const PdoParameters& pdo, std::uint32_t syncs, bool event) {
         return pdo.transmission_type() == 0xFC || former(pdo, syncs, event);
       })},
      {"event-timer-active-in-sync-mode",
       "The event timer also works with synchronous types",
       {"PDO-TX-11", "PDO-TX-05"},
       decides(tpdo_traffic, &TransmitPdoRules::has_event_timer,
               [](const auto&, const PdoParameters&) { return true; })},
      {"1800-tpdo-in-pre-operational",
       "TPDOs are sent in Pre-operational",
       {"OD-1800-28", "PDO-TX-02", "NMT-FSA-21", "CAN-TRF-01"},
       works_also(Service::tpdo, NmtState::pre_operational)},
      {"1a00-count-is-u32", "1A00h:00 has four bytes", {"OD-1A00-01", "OD-GEN-10"}, type(0x1A00, 0, u32)},
      {"1a00-entry-field-order-wrong",
       "The default entry of 1A00h:01 has its fields in the wrong order",
       {"OD-1A00-02"},
       preset(0x1A00, 1, 0x08016000)},
      {"1a00-entry-points-nowhere",
       "The default entry of 1A00h:01 names an absent object",
       {"OD-1A00-02"},
       preset(0x1A00, 1, 0x61FF0108)},
      {"1a00-absent-object-mapped",
       "Absent objects can be mapped to a TPDO",
       {"OD-1A00-06", "PDO-MAP-05", "OD-TYP-23"},
       maps_absent_objects(tpdo_parameters)},
      {"1a00-unmappable-object-mapped",
       "Objects that are not mappable can be mapped to a TPDO",
       {"OD-1A00-07", "PDO-MAP-08", "EDS-VSD-12"},
       everywhere([](Entry& entry) { entry.tx_mappable = true; })},
      {"1a00-unmappable-wrong-abort",
       "Mapping an object that is not mappable is aborted with 0607 0010h",
       {"OD-1A00-07"},
       wrong_abort(abort_code::not_mappable, abort_code::length_mismatch, {0x1A00, 0x1A00})},
      {"1a00-length-mismatch-accepted",
       "The length in a mapping entry of a TPDO is not checked",
       {"OD-1A00-08", "PDO-MAP-10", "PDO-MAP-18"},
       maps_any_length(tpdo_parameters)},
      {"1a00-overlong-mapping-accepted",
       "A TPDO mapping of more than 64 bits is accepted",
       {"OD-1A00-09"},
       takes_count(0x1A00, CountThat::exceeds_64_bits)},
      {"1a00-reserved-count-accepted",
       "1A00h:00 accepts any number",
       {"OD-1A00-10"},
       takes_count(0x1A00, CountThat::exceeds_the_entries)},
      {"1a00-entry-writable-while-enabled",
       "Entries of 1A00h can be changed while the mapping is enabled",
       {"OD-1A00-11"},
       unlocked(tpdo_parameters, PdoPart::mapped_object)},
      {"1a00-mapping-writable-while-valid",
       "1A00h:00 can be changed while the TPDO is valid",
       {"OD-1A00-12"},
       unlocked(tpdo_parameters, PdoPart::mapping)},
      {"1a00-sub41-answers",
       "1A00h:41 exists",
       {"OD-1A00-14"},
       extra(0x1A00, 0x41, integer_entry("Entry 65", u32, Access::rw, 0))},
      {"1a00-data-order-wrong",
       "TPDO data are sent with the most significant byte first",
       {"OD-1A00-15", "PDO-TX-01"},
       sends_values(reversed)},
      {"1a00-dlc-wrong",
       "TPDOs always have eight bytes",
       {"OD-1A00-15", "PDO-TX-01"},
       reshape(Service::tpdo, [](const FilterContext&, Frame& frame) { frame.dlc = 8; })},
  };
}

}  // namespace refnode
