// SPDX-License-Identifier: Apache-2.0
// Defects of RPDOs, parameters (other than COB-IDs) and traffic.
#include <cstddef>
#include <cstdint>

#include "defects/hooks.hpp"
#include "defects/pdos.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u16 = DataType::unsigned16;
constexpr DataType u32 = DataType::unsigned32;

ReceivePdoRules& rpdo_traffic(Parts& parts) { return parts.pdos.rpdo.rules; }

}  // namespace

DefectTable pdo_receive_defects() {
  return {
      {"1400-absent-for-existing-mapping",
       "1600h exists without 1400h",
       {"OD-1400-03", "PDO-DEF-05"},
       absent(0x1400)},
      {"1600-absent-for-existing-pdo",
       "1400h exists without 1600h",
       {"OD-1400-03", "PDO-DEF-05"},
       absent(0x1600)},
      {"1400-sub0-out-of-range", "1400h:00 is 07h", {"OD-1400-01", "OD-GEN-11"}, preset(0x1400, 0, 7)},
      {"1400-sub0-writable",
       "1400h:00 can be written",
       {"OD-1400-02", "SDO-DNL-09"},
       access(0x1400, 0, Access::rw)},
      {"1400-sub2-missing", "1400h:02 does not exist", {"OD-1400-01", "OD-CAT-02"}, absent_sub(0x1400, 2)},
      {"1400-type-is-u16", "1400h:02 has two bytes", {"OD-1400-15", "OD-LEN-04"}, type(0x1400, 2, u16)},
      {"1400-type-not-writable",
       "1400h:02 is read-only in contrast to the description",
       {"OD-1400-15", "SDO-DNL-21"},
       access(0x1400, 2, Access::ro)},
      {"1400-reserved-type-accepted",
       "1400h:02 accepts reserved transmission types",
       {"OD-1400-16", "PDO-RX-12"},
       confirms(0x1400, 2, [](std::uint64_t) { return true; })},
      {"1400-inhibit-lock-missing",
       "1400h:03 can be changed while the RPDO is valid",
       {"OD-1400-18"},
       unlocked(rpdo_parameters, PdoPart::inhibit_time)},
      {"1400-sub4-is-u32",
       "The reserved 1400h:04 exists with four bytes",
       {"OD-1400-19"},
       extra(0x1400, 4, integer_entry("Reserved", u32, Access::rw, 0))},
      {"1400-event-timer-is-u32",
       "1400h:05 has four bytes",
       {"OD-1400-20", "OD-LEN-04"},
       type(0x1400, 5, u32)},
      {"1400-sub6-implemented",
       "1400h:06 exists",
       {"OD-1400-21"},
       both(extra(0x1400, 6, integer_entry("SYNC start value", DataType::unsigned8, Access::rw, 0)),
            preset(0x1400, 0, 6))},
      {"1600-count-is-u32", "1600h:00 has four bytes", {"OD-1600-01", "OD-GEN-10"}, type(0x1600, 0, u32)},
      {"1600-entry-field-order-wrong",
       "The default entry of 1600h:01 has its fields in the wrong order",
       {"OD-1600-02", "PDO-DEF-04"},
       preset(0x1600, 1, 0x08016200)},
      {"1600-entry-points-nowhere",
       "The default entry of 1600h:01 names an absent object",
       {"OD-1600-02", "PDO-DEF-04"},
       preset(0x1600, 1, 0x63FF0108)},
      {"1600-default-mapping-wrong",
       "The first mapped object of the RPDO is another one than the description says",
       {"OD-DSC-07", "OD-DSC-03", "EDS-VSD-05"},
       preset(0x1600, 1, 0x62000308)},
      {"1600-absent-object-mapped",
       "Absent objects can be mapped to an RPDO",
       {"OD-1600-06", "PDO-MAP-04", "PDO-MAP-05", "OD-TYP-22"},
       maps_absent_objects(rpdo_parameters)},
      {"1600-unmappable-object-mapped",
       "Objects that are not mappable can be mapped to an RPDO",
       {"OD-1600-07", "PDO-MAP-06", "PDO-MAP-07", "EDS-VSD-12"},
       everywhere([](Entry& entry) { entry.rx_mappable = true; })},
      {"1600-unmappable-wrong-abort",
       "Mapping an object that is not mappable is aborted with 0607 0010h",
       {"OD-1600-07", "PDO-MAP-06"},
       wrong_abort(abort_code::not_mappable, abort_code::length_mismatch, {0x1600, 0x1600})},
      {"1600-length-mismatch-accepted",
       "The length in a mapping entry of an RPDO is not checked",
       {"OD-1600-08", "PDO-MAP-09", "PDO-MAP-10", "PDO-MAP-18"},
       maps_any_length(rpdo_parameters)},
      {"1600-overlong-mapping-accepted",
       "An RPDO mapping of more than 64 bits is accepted",
       {"OD-1600-09", "PDO-MAP-11"},
       takes_count(0x1600, CountThat::exceeds_64_bits)},
      {"1600-reserved-count-accepted",
       "1600h:00 accepts any number",
       {"OD-1600-10", "PDO-MAP-12", "PDO-MAP-13"},
       takes_count(0x1600, CountThat::exceeds_the_entries)},
      {"1600-entry-writable-while-enabled",
       "Entries of 1600h can be changed while the mapping is enabled",
       {"OD-1600-11", "PDO-MAP-02"},
       unlocked(rpdo_parameters, PdoPart::mapped_object)},
      {"1600-mapping-writable-while-valid",
       "1600h:00 can be changed while the RPDO is valid",
       {"OD-1600-12"},
       unlocked(rpdo_parameters, PdoPart::mapping)},
      {"1600-sub41-answers",
       "1600h:41 exists",
       {"OD-1600-14"},
       extra(0x1600, 0x41, integer_entry("Entry 65", u32, Access::rw, 0))},
      {"1600-data-order-wrong",
       "RPDO data are taken with the most significant byte first",
       {"OD-1600-15", "PDO-RX-01"},
       receives_values(reversed)},
      {"1600-data-not-applied",
       "RPDO data are not taken over",
       {"OD-1600-15", "PDO-RX-01", "OD-1400-23"},
       receives_values([](const Entry& entry, Bytes& value) { value = entry.value; })},
      {"1600-short-rpdo-processed",
       "An RPDO that is too short is processed as far as it goes",
       {"OD-1600-16", "PDO-RX-06"},
       decides(rpdo_traffic, &ReceivePdoRules::processed,
               [](const auto&, std::size_t, std::size_t) { return true; })},
      {"1600-no-8210-emcy",
       "An RPDO that is too short causes no EMCY",
       {"OD-1600-16", "PDO-RX-06"},
       unnoticed(ErrorSource::rpdo, 0x8210)},
      {"1600-long-rpdo-dropped",
       "An RPDO that is too long is dropped",
       {"OD-1600-17", "PDO-RX-07"},
       decides(rpdo_traffic, &ReceivePdoRules::processed,
               [](const auto& former, std::size_t received, std::size_t mapped) {
                 return received <= mapped && former(received, mapped);
               })},
      {"1400-sync-rpdo-applied-at-once",
       "A synchronous RPDO takes effect before the SYNC",
       {"OD-1400-22", "PDO-RX-03"},
       decides(rpdo_traffic, &ReceivePdoRules::waits_for_sync,
               [](const auto&, std::uint8_t) { return false; })},
      {"rpdo-processed-in-preop",
       "RPDOs are processed in Pre-operational",
       {"PDO-RX-02", "NMT-FSA-21"},
       works_also(Service::rpdo, NmtState::pre_operational)},
  };
}

}  // namespace refnode
