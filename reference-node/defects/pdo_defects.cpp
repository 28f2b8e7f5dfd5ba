// SPDX-License-Identifier: Apache-2.0
// Defects of PDO parameters (other than COB-IDs) and of PDO traffic.
#include <iterator>

#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u16 = DataType::unsigned16;
constexpr DataType u32 = DataType::unsigned32;

DefectTable receive_rows() {
  using B = Behaviour;
  using P = PdoFaults;
  constexpr auto rpdo = &B::rpdo;
  return {
      {"1400-absent-for-existing-mapping", "1600h exists without 1400h", {"OD-1400-03", "PDO-DEF-05"}, absent(0x1400)},
      {"1600-absent-for-existing-pdo", "1400h exists without 1600h", {"OD-1400-03", "PDO-DEF-05"}, absent(0x1600)},
      {"1400-sub0-out-of-range", "1400h:00 is 07h", {"OD-1400-01", "OD-GEN-11"}, preset(0x1400, 0, 7)},
      {"1400-sub0-writable", "1400h:00 can be written", {"OD-1400-02", "SDO-DNL-09"}, access(0x1400, 0, Access::rw)},
      {"1400-sub2-missing", "1400h:02 does not exist", {"OD-1400-01", "OD-CAT-02"}, absent_sub(0x1400, 2)},
      {"1400-type-is-u16", "1400h:02 has two bytes", {"OD-1400-15", "OD-LEN-04"}, type(0x1400, 2, u16)},
      {"1400-type-not-writable", "1400h:02 is read-only in contrast to the description", {"OD-1400-15", "SDO-DNL-21"}, access(0x1400, 2, Access::ro)},
      {"1400-reserved-type-accepted", "1400h:02 accepts reserved transmission types", {"OD-1400-16", "PDO-RX-12"}, behave(rpdo, &P::reserved_type_accepted)},
      {"1400-inhibit-lock-missing", "1400h:03 can be changed while the RPDO is valid", {"OD-1400-18"}, behave(rpdo, &P::inhibit_lock_missing)},
      {"1400-sub4-is-u32", "The reserved 1400h:04 exists with four bytes", {"OD-1400-19"}, extra(0x1400, 4, integer_entry("Reserved", u32, Access::rw, 0))},
      {"1400-event-timer-is-u32", "1400h:05 has four bytes", {"OD-1400-20", "OD-LEN-04"}, type(0x1400, 5, u32)},
      {"1400-sub6-implemented", "1400h:06 exists", {"OD-1400-21"}, both(extra(0x1400, 6, integer_entry("SYNC start value", DataType::unsigned8, Access::rw, 0)), preset(0x1400, 0, 6))},
      {"1600-count-is-u32", "1600h:00 has four bytes", {"OD-1600-01", "OD-GEN-10"}, type(0x1600, 0, u32)},
      {"1600-entry-field-order-wrong", "The default entry of 1600h:01 has its fields in the wrong order", {"OD-1600-02", "PDO-DEF-04"}, preset(0x1600, 1, 0x08016200)},
      {"1600-entry-points-nowhere", "The default entry of 1600h:01 names an absent object", {"OD-1600-02", "PDO-DEF-04"}, preset(0x1600, 1, 0x63FF0108)},
      {"1600-absent-object-mapped", "Absent objects can be mapped to an RPDO", {"OD-1600-06", "PDO-MAP-04", "PDO-MAP-05"}, behave(rpdo, &P::absent_object_mapped)},
      {"1600-unmappable-object-mapped", "Objects that are not mappable can be mapped to an RPDO", {"OD-1600-07", "PDO-MAP-06", "PDO-MAP-07"}, behave(rpdo, &P::unmappable_object_mapped)},
      {"1600-unmappable-wrong-abort", "Mapping an object that is not mappable is aborted with 0607 0010h",
       {"OD-1600-07", "PDO-MAP-06"}, wrong_abort(abort_code::not_mappable, abort_code::length_mismatch, {0x1600, 0x1600})},
      {"1600-length-mismatch-accepted", "The length in a mapping entry of an RPDO is not checked", {"OD-1600-08", "PDO-MAP-09", "PDO-MAP-10", "PDO-MAP-18"}, behave(rpdo, &P::mapping_length_unchecked)},
      {"1600-overlong-mapping-accepted", "An RPDO mapping of more than 64 bits is accepted", {"OD-1600-09", "PDO-MAP-11"}, behave(rpdo, &P::overlong_mapping_accepted)},
      {"1600-reserved-count-accepted", "1600h:00 accepts any number", {"OD-1600-10", "PDO-MAP-12", "PDO-MAP-13"}, behave(rpdo, &P::mapping_count_unchecked)},
      {"1600-entry-writable-while-enabled", "Entries of 1600h can be changed while the mapping is enabled", {"OD-1600-11", "PDO-MAP-02"}, behave(rpdo, &P::mapping_writable_while_enabled)},
      {"1600-mapping-writable-while-valid", "1600h:00 can be changed while the RPDO is valid", {"OD-1600-12"}, behave(rpdo, &P::mapping_writable_while_valid)},
      {"1600-sub41-answers", "1600h:41 exists", {"OD-1600-14"}, extra(0x1600, 0x41, integer_entry("Entry 65", u32, Access::rw, 0))},
      {"1600-data-order-wrong", "RPDO data are taken with the most significant byte first", {"OD-1600-15", "PDO-RX-01"}, behave(&B::rpdo_data_big_endian)},
      {"1600-data-not-applied", "RPDO data are not taken over", {"OD-1600-15", "PDO-RX-01", "OD-1400-23"}, behave(&B::rpdo_data_ignored)},
      {"1600-short-rpdo-processed", "An RPDO that is too short is processed as far as it goes", {"OD-1600-16", "PDO-RX-06"}, behave(&B::short_rpdo_processed)},
      {"1600-no-8210-emcy", "An RPDO that is too short causes no EMCY", {"OD-1600-16", "PDO-RX-06"}, behave(&B::short_rpdo_not_reported)},
      {"1600-long-rpdo-dropped", "An RPDO that is too long is dropped", {"OD-1600-17", "PDO-RX-07"}, behave(&B::long_rpdo_dropped)},
      {"1400-sync-rpdo-applied-at-once", "A synchronous RPDO takes effect before the SYNC", {"OD-1400-22", "PDO-RX-03"}, behave(&B::sync_rpdo_applied_at_once)},
      {"rpdo-processed-in-preop", "RPDOs are processed in Pre-operational", {"PDO-RX-02", "NMT-FSA-21"}, behave(&B::rpdo_processed_in_pre_operational)},
  };
}

DefectTable transmit_rows() {
  using B = Behaviour;
  using P = PdoFaults;
  constexpr auto tpdo = &B::tpdo;
  return {
      {"1800-absent-for-existing-mapping", "1A00h exists without 1800h", {"OD-1800-03", "PDO-DEF-05"}, absent(0x1800)},
      {"1a00-absent-for-existing-pdo", "1800h exists without 1A00h", {"OD-1800-03", "PDO-DEF-05"}, absent(0x1A00)},
      {"1800-sub0-out-of-range", "1800h:00 is 07h", {"OD-1800-01", "OD-GEN-11"}, preset(0x1800, 0, 7)},
      {"1800-sub0-writable", "1800h:00 can be written", {"OD-1800-02", "SDO-DNL-09"}, access(0x1800, 0, Access::rw)},
      {"1800-sub2-missing", "1800h:02 does not exist", {"OD-1800-01", "OD-CAT-02"}, absent_sub(0x1800, 2)},
      {"1800-type-is-u16", "1800h:02 has two bytes", {"OD-1800-15", "OD-LEN-04"}, type(0x1800, 2, u16)},
      {"1800-type-not-writable", "1800h:02 is read-only in contrast to the description", {"OD-1800-15", "SDO-DNL-21"}, access(0x1800, 2, Access::ro)},
      {"1800-reserved-type-accepted", "1800h:02 accepts reserved transmission types", {"OD-1800-16", "PDO-TX-17"}, behave(tpdo, &P::reserved_type_accepted)},
      {"1800-inhibit-lock-missing", "1800h:03 can be changed while the TPDO is valid", {"OD-1800-18", "PDO-TX-13"}, behave(tpdo, &P::inhibit_lock_missing)},
      {"1800-sub4-is-u32", "The reserved 1800h:04 exists with four bytes", {"OD-1800-19"}, extra(0x1800, 4, integer_entry("Reserved", u32, Access::rw, 0))},
      {"1800-event-timer-is-u32", "1800h:05 has four bytes", {"OD-1800-20", "OD-LEN-04"}, type(0x1800, 5, u32)},
      {"1800-event-timer-ignored", "The event timer of 1800h:05 has no effect", {"OD-1800-25", "PDO-TX-09"}, behave(tpdo, &P::event_timer_factor, 0)},
      {"1800-event-timer-unit-wrong", "1800h:05 counts in units of 10 ms", {"OD-1800-25", "PDO-TX-09"}, behave(tpdo, &P::event_timer_factor, 10)},
      {"1800-inhibit-ignored", "The inhibit time of 1800h:03 has no effect", {"OD-1800-26", "PDO-TX-12"}, behave(tpdo, &P::inhibit_unit_us, 0)},
      {"1800-inhibit-unit-10us", "1800h:03 counts in units of 10 us", {"OD-1800-26", "PDO-TX-12"}, behave(tpdo, &P::inhibit_unit_us, 10)},
      {"1800-cyclic-ratio-wrong", "Synchronous TPDOs are sent one SYNC too late", {"OD-1800-22", "PDO-TX-05", "PDO-TX-06", "SYNC-CON-01"}, behave(&B::sync_ratio_off_by_one)},
      {"1800-acyclic-sends-every-sync", "Transmission type 00h sends with every SYNC", {"OD-1800-23", "PDO-TX-07"}, behave(&B::acyclic_type_sends_every_sync)},
      {"1800-rtr-type-sends-unasked", "Transmission type FCh sends with the SYNC", {"OD-1800-24", "PDO-TX-20"}, behave(&B::remote_type_sends_at_sync)},
      {"event-timer-active-in-sync-mode", "The event timer also works with synchronous types", {"PDO-TX-11"}, behave(&B::event_timer_in_synchronous_types)},
      {"1800-tpdo-in-pre-operational", "TPDOs are sent in Pre-operational", {"OD-1800-28", "PDO-TX-02", "NMT-FSA-21"}, behave(&B::tpdo_sent_in_pre_operational)},
      {"1a00-count-is-u32", "1A00h:00 has four bytes", {"OD-1A00-01", "OD-GEN-10"}, type(0x1A00, 0, u32)},
      {"1a00-entry-field-order-wrong", "The default entry of 1A00h:01 has its fields in the wrong order", {"OD-1A00-02", "PDO-DEF-04"}, preset(0x1A00, 1, 0x08016000)},
      {"1a00-entry-points-nowhere", "The default entry of 1A00h:01 names an absent object", {"OD-1A00-02", "PDO-DEF-04"}, preset(0x1A00, 1, 0x61FF0108)},
      {"1a00-absent-object-mapped", "Absent objects can be mapped to a TPDO", {"OD-1A00-06", "PDO-MAP-04", "PDO-MAP-05"}, behave(tpdo, &P::absent_object_mapped)},
      {"1a00-unmappable-object-mapped", "Objects that are not mappable can be mapped to a TPDO", {"OD-1A00-07", "PDO-MAP-06", "PDO-MAP-08"}, behave(tpdo, &P::unmappable_object_mapped)},
      {"1a00-unmappable-wrong-abort", "Mapping an object that is not mappable is aborted with 0607 0010h",
       {"OD-1A00-07", "PDO-MAP-06"}, wrong_abort(abort_code::not_mappable, abort_code::length_mismatch, {0x1A00, 0x1A00})},
      {"1a00-length-mismatch-accepted", "The length in a mapping entry of a TPDO is not checked", {"OD-1A00-08", "PDO-MAP-09", "PDO-MAP-10", "PDO-MAP-18"}, behave(tpdo, &P::mapping_length_unchecked)},
      {"1a00-overlong-mapping-accepted", "A TPDO mapping of more than 64 bits is accepted", {"OD-1A00-09", "PDO-MAP-11"}, behave(tpdo, &P::overlong_mapping_accepted)},
      {"1a00-reserved-count-accepted", "1A00h:00 accepts any number", {"OD-1A00-10", "PDO-MAP-12", "PDO-MAP-13"}, behave(tpdo, &P::mapping_count_unchecked)},
      {"1a00-entry-writable-while-enabled", "Entries of 1A00h can be changed while the mapping is enabled", {"OD-1A00-11", "PDO-MAP-02"}, behave(tpdo, &P::mapping_writable_while_enabled)},
      {"1a00-mapping-writable-while-valid", "1A00h:00 can be changed while the TPDO is valid", {"OD-1A00-12"}, behave(tpdo, &P::mapping_writable_while_valid)},
      {"1a00-sub41-answers", "1A00h:41 exists", {"OD-1A00-14"}, extra(0x1A00, 0x41, integer_entry("Entry 65", u32, Access::rw, 0))},
      {"1a00-data-order-wrong", "TPDO data are sent with the most significant byte first", {"OD-1A00-15", "PDO-TX-01"}, behave(&B::tpdo_data_big_endian)},
      {"1a00-dlc-wrong", "TPDOs always have eight bytes", {"OD-1A00-15", "PDO-TX-01"},
       reshape(Service::tpdo, [](const FilterContext&, Frame& frame) { frame.dlc = 8; })},
  };
}

}  // namespace

DefectTable pdo_defects() {
  DefectTable rows = receive_rows();
  DefectTable more = transmit_rows();
  rows.insert(rows.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  return rows;
}

}  // namespace refnode
