// SPDX-License-Identifier: Apache-2.0
// Defects of PDO parameters (other than COB-IDs) and of PDO traffic.
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>

#include "defects/hooks.hpp"
#include "defects/tools.hpp"
#include "pdo/bits.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u16 = DataType::unsigned16;
constexpr DataType u32 = DataType::unsigned32;

PdoRules& rpdo_parameters(Parts& parts) { return parts.pdos.rpdo.parameters.rules; }
PdoRules& tpdo_parameters(Parts& parts) { return parts.pdos.tpdo.parameters.rules; }
ReceivePdoRules& rpdo_traffic(Parts& parts) { return parts.pdos.rpdo.rules; }
TransmitPdoRules& tpdo_traffic(Parts& parts) { return parts.pdos.tpdo.rules; }

using Parameters = PdoRules& (*)(Parts&);

Change unlocked(Parameters of, PdoPart part) {
  return decides(of, &PdoRules::locked, [part](const auto& former, PdoPart which, bool valid, bool enabled) {
    return which != part && former(which, valid, enabled);
  });
}

Change maps_absent_objects(Parameters of) {
  return decides(of, &PdoRules::mappable, [](const auto& former, const Mapped& mapped) {
    const Accepted allowed = former(mapped);
    return !allowed && allowed.error() == abort_code::no_object ? Accepted{} : allowed;
  });
}

/// Whatever length is given, it is taken for the right one.
Change maps_any_length(Parameters of) {
  return [of](Parts& parts) {
    of(parts).mappable.replace([&parts](const auto& former, Mapped mapped) {
      const Entry* entry = parts.device.dictionary.entry(mapped.index, mapped.sub);
      if (entry != nullptr) mapped.bits = static_cast<std::uint8_t>(entry->value.size() * 8);
      return former(mapped);
    });
  };
}

enum class CountThat : std::uint8_t { exceeds_the_entries, exceeds_64_bits };

/// Sub-index 00h of the mapping takes a count although it is too large in this way.
Change takes_count(std::uint16_t index, CountThat too_large) {
  return checking(index, 0, [=](Parts& parts, const Check& former, ByteView bytes) {
    const Accepted taken = former(bytes);
    const bool there = parts.device.dictionary.entry(index, bytes[0]) != nullptr;
    const CountThat reason = there ? CountThat::exceeds_64_bits : CountThat::exceeds_the_entries;
    const bool too_long = !taken && taken.error() == abort_code::mapping_too_long;
    return too_long && reason == too_large ? Accepted{} : taken;
  });
}

/// A time of the TPDO is another one than it should be.
Change counts(Rule<Duration(std::int64_t)> PdoRules::* time, Duration (*as)(Duration right)) {
  return decides(tpdo_parameters, time,
                 [as](const auto& former, std::int64_t value) { return as(former(value)); });
}

using SentAtSync = Rule<bool(std::uint8_t, std::uint32_t, bool)>::Decision;

Change at_sync(bool (*sent)(const SentAtSync& former, std::uint8_t type, std::uint32_t syncs, bool event)) {
  return decides(tpdo_traffic, &TransmitPdoRules::sent_at_sync, sent);
}

using ValueChange = void (*)(const Entry& mapped, Bytes& value);

/// Changes what a frame of the first PDO of its direction carries, one mapped object after the other.
void change_values(const ObjectDictionary& od, PdoDirection direction, Frame& frame, ValueChange change) {
  constexpr std::uint8_t most_mapped = 0x40;
  const std::uint16_t communication = first_communication_index(direction);
  const auto mapping = static_cast<std::uint16_t>(communication + 0x200);
  if (frame.id != (od.number(communication, 1) & 0x7FFU)) return;
  const std::span<std::uint8_t> data = std::span(frame.data).first(frame.size());
  std::size_t position = 0;  // in bits
  for (std::uint8_t sub = 1; sub <= od.number(mapping, 0) && sub <= most_mapped; ++sub) {
    const Mapped mapped = Mapped::unpack(od.number(mapping, sub));
    if (position + mapped.bits > data.size() * 8) break;
    const Entry* entry = od.entry(mapped.index, mapped.sub);
    if (entry != nullptr) {
      Bytes value(whole_bytes(mapped.bits));
      copy_bits(data, position, value, 0, mapped.bits);
      change(*entry, value);
      value.resize(whole_bytes(mapped.bits));
      copy_bits(value, 0, data, position, mapped.bits);
    }
    position += mapped.bits;
  }
}

void reversed(const Entry&, Bytes& value) { std::ranges::reverse(value); }

Change receives_values(ValueChange as) {
  return misreads([as](Parts& parts, Frame& frame) {
    change_values(parts.device.dictionary, PdoDirection::receive, frame, as);
  });
}

Change sends_values(ValueChange as) {
  return [as](Parts& parts) {
    parts.device.outbox.add_filter([&parts, as](const FilterContext& context, std::vector<Outgoing>& frames) {
      if (context.service != Service::tpdo) return;
      for (Outgoing& outgoing : frames)
        change_values(parts.device.dictionary, PdoDirection::transmit, outgoing.frame, as);
    });
  };
}

DefectTable receive_rows() {
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

DefectTable transmit_rows() {
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
       at_sync([](const SentAtSync& former, std::uint8_t type, std::uint32_t syncs, bool event) {
         return former(type, syncs - 1, event);
       })},
      {"1800-acyclic-sends-every-sync",
       "Transmission type 00h sends with every SYNC",
       {"OD-1800-23", "PDO-TX-07"},
       at_sync([](const SentAtSync& former, std::uint8_t type, std::uint32_t syncs, bool event) {
         return type == 0 || former(type, syncs, event);
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
       at_sync([](const SentAtSync& former, std::uint8_t type, std::uint32_t syncs, bool event) {
         return type == 0xFC || former(type, syncs, event);
       })},
      {"event-timer-active-in-sync-mode",
       "The event timer also works with synchronous types",
       {"PDO-TX-11"},
       decides(tpdo_traffic, &TransmitPdoRules::has_event_timer,
               [](const auto&, std::uint8_t) { return true; })},
      {"1800-tpdo-in-pre-operational",
       "TPDOs are sent in Pre-operational",
       {"OD-1800-28", "PDO-TX-02", "NMT-FSA-21"},
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

}  // namespace

DefectTable pdo_defects() {
  DefectTable rows = receive_rows();
  DefectTable more = transmit_rows();
  rows.insert(rows.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  return rows;
}

}  // namespace refnode
