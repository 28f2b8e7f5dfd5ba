// SPDX-License-Identifier: Apache-2.0
// PDOs: parameters, mappings, transmission types, remote frames and the first PDO.
#include <chrono>
#include <vector>

#include "variants/tools.hpp"

namespace refnode {

using namespace variant;
using std::chrono::milliseconds;

namespace {

/// Sub-index 04h as older devices have it: one byte, without meaning.
How compatibility_entry(std::uint16_t index) {
  return [index](Parts& parts) {
    if (parts.device.dictionary.objects().contains(index))
      parts.device.dictionary.add_sub(index, 4,
                                      integer_entry("Reserved", DataType::unsigned8, Access::rw, 0));
  };
}

/// The same of all four PDOs of a direction; `how` is given the index of each one's parameter.
How of_all(std::uint16_t first, const std::function<How(std::uint16_t index)>& how) {
  return both(both(how(first), how(static_cast<std::uint16_t>(first + 1))),
              both(how(static_cast<std::uint16_t>(first + 2)), how(static_cast<std::uint16_t>(first + 3))));
}

/// Their mappings are fixed.
How constant_mappings(std::uint16_t first) {
  return of_all(first, [](std::uint16_t index) { return access_all(index, Access::rw, Access::constant); });
}

/// COB-ID, inhibit time and mapping of each PDO are what they are.
How constant_pdos(std::uint16_t communication, std::uint16_t mapping) {
  return both(of_all(communication,
                     [](std::uint16_t index) {
                       return both(access(index, 1, Access::constant), access(index, 3, Access::constant));
                     }),
              constant_mappings(mapping));
}

/// The default of sub-index 02h.
How types(std::uint16_t first, std::uint64_t type) {
  return of_all(first, [type](std::uint16_t index) { return preset(index, 2, type); });
}

How choose_of_rpdos(void (*change)(PdoChoices&)) {
  return [change](Parts& parts) { change(parts.pdos.rpdo.parameters.choices); };
}

How choose_of_tpdos(void (*change)(PdoChoices&)) {
  return [change](Parts& parts) { change(parts.pdos.tpdo.parameters.choices); };
}

}  // namespace

VariantTable pdo_variants() {
  return {
      {.id = "rpdo-absent",
       .summary = "receives no PDO",
       .legal = "7.5.2.35: if RPDOs are supported",
       .how = absent({0x1400, 0x1401, 0x1402, 0x1403, 0x1600, 0x1601, 0x1602, 0x1603}),
       .group = "rpdo",
       .lacks = {"rpdo"}},
      {.id = "tpdo-absent",
       .summary = "transmits no PDO",
       .legal = "7.5.2.37: if TPDOs are supported",
       .how = absent({0x1800, 0x1801, 0x1802, 0x1803, 0x1A00, 0x1A01, 0x1A02, 0x1A03}),
       .group = "tpdo",
       .lacks = {"tpdo", "remote frames"}},
      {.id = "pdo-absent",
       .summary = "no PDOs",
       .legal = "7.5.2.35, 7.5.2.37: if PDOs are supported",
       .how = both(absent({0x1400, 0x1401, 0x1402, 0x1403, 0x1600, 0x1601, 0x1602, 0x1603}),
                   absent({0x1800, 0x1801, 0x1802, 0x1803, 0x1A00, 0x1A01, 0x1A02, 0x1A03})),
       .group = "rpdo",
       .excludes = {"tpdo"},
       .lacks = {"rpdo", "tpdo", "variable mapping", "remote frames"}},
      {.id = "rpdo-one",
       .summary = "one RPDO",
       .legal = "7.5.2.35: as many as are supported",
       .how = absent({0x1401, 0x1402, 0x1403, 0x1601, 0x1602, 0x1603}),
       .group = "rpdo"},
      {.id = "tpdo-one",
       .summary = "one TPDO",
       .legal = "7.5.2.37: as many as are supported",
       .how = absent({0x1801, 0x1802, 0x1803, 0x1A01, 0x1A02, 0x1A03}),
       .group = "tpdo"},
      {.id = "rpdo-first-and-last",
       .summary = "RPDO 1 and RPDO 4 and none between them",
       .legal = "7.5.2.35: numbers may be left out",
       .how = absent({0x1401, 0x1402, 0x1601, 0x1602}),
       .group = "rpdo"},
      {.id = "tpdo-first-and-last",
       .summary = "TPDO 1 and TPDO 4 and none between them",
       .legal = "7.5.2.37: numbers may be left out",
       .how = absent({0x1801, 0x1802, 0x1A01, 0x1A02}),
       .group = "tpdo"},
      {.id = "tpdo-third-only",
       .summary = "TPDO 3 and no other",
       .legal = "7.5.2.37: numbers may be left out",
       .how = absent({0x1800, 0x1801, 0x1803, 0x1A00, 0x1A01, 0x1A03}),
       .group = "tpdo"},
      {.id = "rpdo-second-only",
       .summary = "RPDO 2 and no other",
       .legal = "7.5.2.35: numbers may be left out",
       .how = absent({0x1400, 0x1402, 0x1403, 0x1600, 0x1602, 0x1603}),
       .group = "rpdo"},
      {"tpdos-start-at-sync-3", "TPDOs wait for SYNC 3 by default", "7.5.2.37: a SYNC start value",
       of_all(0x1800, [](std::uint16_t index) { return preset(index, 6, 3); }), "1800-timers"},
      {"tpdos-start-at-sync-2-const", "TPDOs wait for SYNC 2, which cannot be changed",
       "7.5.2.37: a SYNC start value",
       of_all(
           0x1800,
           [](std::uint16_t index) { return both(preset(index, 6, 2), access(index, 6, Access::constant)); }),
       "1800-timers"},
      {"rpdos-deadline-200ms",
       "a deadline of 200 ms for every RPDO by default",
       "OD-1400-20: an event timer",
       of_all(0x1400, [](std::uint16_t index) { return preset(index, 5, 200); }),
       "1400-subs",
       // It would leave Operational 200 ms after each start.
       {"error-ends-operational", "error-prevents-operational", "like-canopennode"}},
      {"1403-const", "COB-ID, inhibit time and mapping of the last RPDO cannot be changed",
       "OD-1400-12, OD-1600-04: const",
       both(both(access(0x1403, 1, Access::constant), access(0x1403, 3, Access::constant)),
            access_all(0x1603, Access::rw, Access::constant)),
       "1603"},
      {"1803-const", "COB-ID, inhibit time and mapping of the last TPDO cannot be changed",
       "OD-1800-12, OD-1A00-04: const",
       both(both(access(0x1803, 1, Access::constant), access(0x1803, 3, Access::constant)),
            access_all(0x1A03, Access::rw, Access::constant)),
       "1A03"},
      {"rpdos-const", "COB-ID, inhibit time and mapping of no RPDO can be changed",
       "OD-1400-12, OD-1600-04: const", constant_pdos(0x1400, 0x1600), "1600"},
      {"tpdos-const", "COB-ID, inhibit time and mapping of no TPDO can be changed",
       "OD-1800-12, OD-1A00-04: const", constant_pdos(0x1800, 0x1A00), "1A00"},
      {"rpdos-not-valid",
       "no RPDO is valid by default",
       "OD-1400-04: bit 31 is not judged",
       both(both(preset_with_node_id(0x1400, 1, 0x80000200), preset_with_node_id(0x1401, 1, 0x80000300)),
            both(preset_with_node_id(0x1402, 1, 0x80000400), preset_with_node_id(0x1403, 1, 0x80000500))),
       {},
       {"1400-const", "1403-const", "rpdos-const", "1400-not-valid", "1400-bit-30"}},
      {"tpdos-not-valid",
       "no TPDO is valid by default",
       "OD-1800-04: bit 31 is not judged",
       both(both(preset_with_node_id(0x1800, 1, 0xC0000180), preset_with_node_id(0x1801, 1, 0xC0000280)),
            both(preset_with_node_id(0x1802, 1, 0xC0000380), preset_with_node_id(0x1803, 1, 0xC0000480))),
       {},
       {"1800-const", "1803-const", "tpdos-const", "1800-not-valid"}},
      {"rpdos-sub-2", "neither inhibit time nor event timer of any RPDO", "OD-1400-01: 02h to 05h",
       of_all(0x1400, [](std::uint16_t index) { return absent_from(index, 3); }), "1400-subs"},
      {"tpdos-sub-2", "neither inhibit time nor event timer of any TPDO", "OD-1800-01: 02h to 06h",
       of_all(0x1800, [](std::uint16_t index) { return absent_from(index, 3); }), "1800-timers"},
      {"tpdos-sub-3",
       "no event timer and no SYNC start value of any TPDO",
       "OD-1800-01: 02h to 06h",
       of_all(0x1800, [](std::uint16_t index) { return absent_from(index, 4); }),
       "1800-timers",
       {"1800-sub-3-absent"}},
      {"tpdos-sub-5", "no SYNC start value of any TPDO", "OD-1800-01: 02h to 06h",
       of_all(0x1800, [](std::uint16_t index) { return absent_from(index, 6); }), "1800-timers"},
      {"tpdos-sub-3-absent", "no inhibit time of any TPDO", "OD-1800-01: gaps at 03h to 05h",
       of_all(0x1800, [](std::uint16_t index) { return gap(index, 3); }), "1800-timers"},
      {"rpdos-type-const", "the transmission types of all RPDOs are fixed", "7.5.2.35: rw or const",
       of_all(0x1400, [](std::uint16_t index) { return access(index, 2, Access::constant); })},
      {"tpdos-type-const", "the transmission types of all TPDOs are fixed", "7.5.2.37: rw or const",
       of_all(0x1800, [](std::uint16_t index) { return access(index, 2, Access::constant); })},
      {"rpdos-four", "four mapping entries in every RPDO", "OD-1600-01: up to 40h",
       of_all(0x1600, [](std::uint16_t index) { return absent_from(index, 5); }), "1600"},
      {"tpdos-four", "four mapping entries in every TPDO", "OD-1A00-01: up to 40h",
       of_all(0x1A00, [](std::uint16_t index) { return absent_from(index, 5); }), "1A00"},
      {"rpdo-mapping-const", "no mapping of an RPDO can be changed", "OD-1600-04", constant_mappings(0x1600),
       "1600"},
      {"tpdo-mapping-const", "no mapping of a TPDO can be changed", "OD-1A00-04", constant_mappings(0x1A00),
       "1A00"},
      // A PDO that cannot be switched off has nothing that may be changed only while it is off.
      {"1400-const", "COB-ID, inhibit time and mapping of the RPDO cannot be changed",
       "OD-1400-12, OD-1600-04: const",
       both(both(access(0x1400, 1, Access::constant), access(0x1400, 3, Access::constant)),
            access_all(0x1600, Access::rw, Access::constant)),
       "1600"},
      {"1400-not-valid",
       "the RPDO is not valid by default",
       "OD-1400-04: bit 31 is not judged",
       preset_with_node_id(0x1400, 1, 0x80000200),
       {},
       {"1400-const", "rpdos-const"}},
      {"1400-sub-2", "neither inhibit time nor event timer of the RPDO", "OD-1400-01: 02h to 05h",
       absent_from(0x1400, 3), "1400-subs"},
      {"1400-sub-3-absent", "no inhibit time of the RPDO", "OD-1400-01: gaps at 03h to 05h", gap(0x1400, 3)},
      {"1400-type-const", "the transmission type of the RPDO is fixed", "7.5.2.35: rw or const",
       access(0x1400, 2, Access::constant)},
      {"1400-type-FE", "transmission type FEh by default", "7.5.2.35: FEh is as event-driven as FFh",
       preset(0x1400, 2, 0xFE)},
      {"1600-const", "the mapping of the RPDO is fixed", "OD-1600-04",
       access_all(0x1600, Access::rw, Access::constant), "1600"},
      {"1600-empty", "nothing is mapped by default", "OD-1600-01: 00h", preset(0x1600, 0, 0), "1600"},
      {"1600-four", "four mapping entries", "OD-1600-01: up to 40h", absent_from(0x1600, 5), "1600"},
      {"1800-const", "COB-ID, inhibit time and mapping of the TPDO cannot be changed",
       "OD-1800-12, OD-1A00-04: const",
       both(both(access(0x1800, 1, Access::constant), access(0x1800, 3, Access::constant)),
            access_all(0x1A00, Access::rw, Access::constant)),
       "1A00"},
      {"1800-not-valid",
       "the TPDO is not valid by default",
       "OD-1800-04: bit 31 is not judged",
       preset_with_node_id(0x1800, 1, 0xC0000180),
       {},
       {"1800-const", "tpdos-const"}},
      {"1800-sub-2", "neither inhibit time nor event timer of the TPDO", "OD-1800-01: 02h to 06h",
       absent_from(0x1800, 3), "1800-timers"},
      {"1800-sub-3-absent", "no inhibit time of the TPDO", "OD-1800-01: gaps at 03h to 05h", gap(0x1800, 3)},
      {"1800-type-const", "the transmission type of the TPDO is fixed", "7.5.2.37: rw or const",
       access(0x1800, 2, Access::constant)},
      {"1800-type-FE", "transmission type FEh by default", "7.5.2.37: FEh is as event-driven as FFh",
       preset(0x1800, 2, 0xFE)},
      {"1800-inhibit-10ms", "an inhibit time of 10 ms by default", "7.5.2.37: the default is the device's",
       preset(0x1800, 3, 100), "1800-timers"},
      {"1800-event-20ms", "the event timer runs by default, every 20 ms",
       "7.5.2.37: the default is the device's", preset(0x1800, 5, 20)},
      {"1800-event-500ms", "the event timer runs by default, twice a second",
       "7.5.2.37: the default is the device's", preset(0x1800, 5, 500)},
      {"tpdos-event-100ms-const",
       "the event timers of all TPDOs are fixed to 100 ms",
       "7.5.2.37: rw or const, the default is the device's",
       of_all(0x1800,
              [](std::uint16_t index) {
                return both(preset(index, 5, 100), access(index, 5, Access::constant));
              }),
       {},
       {"1800-event-20ms", "1800-event-500ms"}},
      {.id = "tpdos-late-25ms",
       .summary = "TPDOs are sent 25 ms late",
       .legal = "7.2.2: no time is given; SYNC-CON-08, SYNC-CON-09 warn",
       .how = late(Service::tpdo, milliseconds(25)),
       .group = "late",
       // A heartbeat that shows the new state would wait behind them.
       .excludes = {"nmt-latency", "heartbeat-at-state-change", "heartbeat-restarts-at-state-change"},
       .warns = {"SYNC-CON-08", "SYNC-CON-09"}},
      {"1A00-const", "the mapping of the TPDO is fixed", "OD-1A00-04",
       access_all(0x1A00, Access::rw, Access::constant), "1A00"},
      {"1A00-empty", "nothing is mapped by default", "OD-1A00-01: 00h", preset(0x1A00, 0, 0), "1A00"},
      {"1A00-four", "four mapping entries", "OD-1A00-01: up to 40h", absent_from(0x1A00, 5), "1A00"},
      {.id = "pdo-mapping-const",
       .summary = "no mapping can be changed",
       .legal = "OD-1600-04, OD-1A00-04",
       .how = both(constant_mappings(0x1600), constant_mappings(0x1A00)),
       .group = "1600",
       .excludes = {"1A00"},
       .lacks = {"variable mapping"}},
      {"abort-pdo-inhibit-0601-0000", "the locked inhibit time: unsupported access", "OD-1400-18, OD-1800-18",
       choose_of_pdos([](PdoChoices& c) { c.inhibit_locked = abort_code::unsupported_access; }),
       "inhibit-code"},
      {"abort-pdo-inhibit-0800-0022", "the locked inhibit time: device state", "OD-1400-18, OD-1800-18",
       choose_of_pdos([](PdoChoices& c) { c.inhibit_locked = abort_code::device_state; }), "inhibit-code"},
      {"abort-map-absent-0604-0041", "an absent object cannot be mapped", "OD-1600-06, OD-1A00-06",
       choose_of_pdos([](PdoChoices& c) { c.absent_object = abort_code::not_mappable; })},
      {"abort-map-unmappable-0602-0000", "an unmappable object does not exist for mapping",
       "OD-1600-07, OD-1A00-07",
       choose_of_pdos([](PdoChoices& c) { c.unmappable_object = abort_code::no_object; })},
      {"abort-map-length-0607-0010", "a wrong length in a mapping entry",
       "OD-1600-08, OD-1A00-08, PDO-MAP-10",
       choose_of_pdos([](PdoChoices& c) { c.wrong_length = abort_code::length_mismatch; }), "map-length"},
      {"abort-map-length-0604-0042", "a wrong length in a mapping entry exceeds the PDO",
       "OD-1600-08, OD-1A00-08, PDO-MAP-10",
       choose_of_pdos([](PdoChoices& c) { c.wrong_length = abort_code::mapping_too_long; }), "map-length"},
      {"abort-map-length-0609-0030", "a wrong length in a mapping entry is an invalid value",
       "OD-1600-08, OD-1A00-08, PDO-MAP-10",
       choose_of_pdos([](PdoChoices& c) { c.wrong_length = abort_code::invalid_value; }), "map-length"},
      {"abort-map-count-0609-0031", "more entries than there are: value too high", "OD-1600-10, OD-1A00-10",
       choose_of_pdos([](PdoChoices& c) { c.too_many = abort_code::value_too_high; }), "map-count"},
      {"abort-map-count-0602-0000", "more entries than there are: no object", "OD-1600-10, OD-1A00-10",
       choose_of_pdos([](PdoChoices& c) { c.too_many = abort_code::no_object; }), "map-count"},
      {"abort-map-long-0602-0000", "a mapping of more than eight bytes: no object", "OD-1600-09, OD-1A00-09",
       choose_of_pdos([](PdoChoices& c) { c.too_long = abort_code::no_object; })},
      {"abort-map-order-0604-0043", "a mapping changed out of order: incompatible", "OD-1600-11, OD-1600-12",
       choose_of_pdos([](PdoChoices& c) { c.out_of_order = abort_code::parameter_incompatible; }),
       "map-order"},
      {"abort-map-order-0800-0022", "a mapping changed out of order: device state", "OD-1600-11, OD-1600-12",
       choose_of_pdos([](PdoChoices& c) { c.out_of_order = abort_code::device_state; }), "map-order"},
      {"abort-map-order-0609-0030", "a mapping changed out of order: invalid value", "OD-1600-11, OD-1600-12",
       choose_of_pdos([](PdoChoices& c) { c.out_of_order = abort_code::invalid_value; }), "map-order"},
      {"map-checked-at-count",
       "a mapping is checked when sub-index 00h is set",
       "OD-1600-06: step 3 or step 4",
       choose_of_pdos([](PdoChoices& c) { c.checked_at_count = true; }),
       {},
       {"1600", "1A00"}},
      // Of an RPDO that is synchronous as it is delivered the other types are refused.
      {.id = "rpdo-event-driven-only",
       .summary = "RPDO types FEh and FFh only",
       .legal = "7.5.2.35: types are the device's",
       .how = choose_of_rpdos([](PdoChoices& c) { c.synchronous_types = false; }),
       .warns = {"PDO-RX-05"}},
      {"tpdo-event-driven-only", "TPDO types FEh and FFh only", "7.5.2.37: types are the device's",
       choose_of_tpdos([](PdoChoices& c) { c.synchronous_types = c.remote_types = false; }), "tpdo-types"},
      {.id = "rpdo-few-types",
       .summary = "RPDO types 01h, FEh and FFh only",
       .legal = "7.5.2.35: types are the device's",
       .how = choose_of_rpdos([](PdoChoices& c) {
         c.acyclic_type = false;
         c.most_syncs = 1;
       }),
       .warns = {"PDO-RX-05"}},
      {"tpdo-few-types", "TPDO types 01h to 0Ah, FEh and FFh only", "7.5.2.37: types are the device's",
       choose_of_tpdos([](PdoChoices& c) {
         c.acyclic_type = c.remote_types = false;
         c.most_syncs = 10;
       }),
       "tpdo-types"},
      {"tpdo-acyclic-absent", "TPDO type 00h is refused", "7.5.2.37: types are the device's",
       choose_of_tpdos([](PdoChoices& c) { c.acyclic_type = false; })},
      {"tpdo-synchronous-only",
       "TPDO types 00h to F0h only, 01h by default",
       "7.5.2.37: types are the device's",
       both(types(0x1800, 1), choose_of_tpdos([](PdoChoices& c) { c.event_types = c.remote_types = false; })),
       "tpdo-types",
       {"sync", "1800-type-FE"}},
      {"rpdo-synchronous-only",
       "RPDO types 00h to F0h only, 01h by default",
       "7.5.2.35: types are the device's",
       both(types(0x1400, 1), choose_of_rpdos([](PdoChoices& c) { c.event_types = false; })),
       {},
       {"sync", "rpdo-event-driven-only", "1400-type-FE"}},
      {"tpdo-remote-types-absent", "TPDO types FCh and FDh are refused", "7.5.2.37: types are the device's",
       choose_of_tpdos([](PdoChoices& c) { c.remote_types = false; })},
      {.id = "tpdo-without-remote-frames",
       .summary = "remote frames are never answered, bit 30 cannot be cleared",
       .legal = "OD-1800-14",
       .how =
           [](Parts& node) {
             PdoTerms& terms = node.pdos.tpdo.parameters;
             terms.cob_id_rules.choices.remote_frames = terms.choices.remote_types = false;
           },
       .lacks = {"remote frames"}},
      {"tpdo-remote-frames-of-its-length-only",
       "remote frames for a TPDO are answered where their DLC is its length",
       "ISO 11898-1: a remote frame has the DLC of the data frame that it asks for",
       [](Parts& node) { node.pdos.tpdo.choices.heeds_remote_dlc = true; }},
      {.id = "tpdo-change-no-event",
       .summary = "a change of mapped data is no event of a TPDO",
       .legal = "7.5.2.37: what an event is, the device and its profile say",
       .how = [](Parts& node) { node.pdos.tpdo.choices.change_is_event = false; },
       .lacks = {"tpdo on change"},
       .warns = {"PDO-TX-07", "PDO-TX-08"}},
      {.id = "tpdo-sent-empty",
       .summary = "a TPDO without mapped objects is sent without data",
       .legal = "PDO-MAP-20 tolerates it",
       .how = [](Parts& node) { node.pdos.tpdo.choices.sent_empty = true; },
       .excludes = {"pdo-unmapped-not-valid"},
       .warns = {"PDO-MAP-20"}},
      {.id = "pdo-unmapped-not-valid",
       .summary = "a PDO without mapped objects reads back as not valid",
       .legal = "PDO-MAP-20",
       .how = choose_of_pdos([](PdoChoices& c) { c.needs_mapping = true; }),
       .excludes = {"1600-empty", "1A00-empty"}},
      {"tpdo-initial", "a TPDO when Operational is entered", "PDO-TX-07, PDO-TX-08",
       [](Parts& node) { node.pdos.tpdo.choices.initial_event = true; }},
      {"tpdo-at-first-sync", "a cyclic TPDO comes with the first SYNC", "PDO-TX-06",
       [](Parts& node) { node.pdos.tpdo.choices.sends_at_first_sync = true; }},
      {.id = "tpdo-counts-from-start-value",
       .summary =
           "the SYNC with the start value is the first one counted, a TPDO of type n comes n - 1 later",
       .legal = "PDO-TX-14 tolerates it",
       .how = [](Parts& node) { node.pdos.tpdo.choices.sends_at_start_value = false; },
       .warns = {"PDO-TX-14"}},
      {"tpdo-in-the-middle", "a TPDO of type n comes with SYNC n / 2 + 1 first", "PDO-TX-06",
       [](Parts& node) { node.pdos.tpdo.choices.sends_in_the_middle = true; }},
      {"tpdo-type-0-timed",
       "the end of the event timer is an event for a TPDO of type 00h: the next SYNC sends it", "PDO-TX-07",
       [](Parts& node) { node.pdos.tpdo.choices.timer_is_event = true; }},
      {"tpdo-when-set",
       "a TPDO when Operational is entered, and when its parameters are written there",
       "PDO-TX-07, PDO-TX-08",
       [](Parts& node) {
         node.pdos.tpdo.choices.initial_event = node.pdos.tpdo.choices.sent_when_set = true;
       },
       {},
       {"late"}},
      {"tpdo-timer-from-the-last", "a new event time counts from the last TPDO",
       "7.5.2.37: the longest interval", [](Parts& node) { node.pdos.tpdo.choices.timer_goes_on = true; }},
      {"tpdo-on-write", "a write of what is mapped is an event, also of the value that there is",
       "7.5.2.37: what an event is, the device and its profile say",
       [](Parts& node) { node.pdos.tpdo.choices.write_is_event = true; }},
      {.id = "tpdo-first-alone-is-sent",
       .summary = "of several TPDOs that carry what has changed the first one is sent",
       .legal = "7.5.2.37: what an event is, the device and its profile say; PDO-TX-08 warns",
       .how = [](Parts& node) { node.pdos.tpdo.choices.first_alone_is_sent = true; },
       // What cannot be switched off takes the place of the TPDO that is tried.
       .excludes = {"tpdo-on-write", "1800-const", "1803-const", "tpdos-const", "like-canopen-stack"},
       .warns = {"PDO-TX-08"}},
      {"tpdo-inhibit-in-10-ms", "inhibit times are rounded up to 10 ms", "7.5.2.37: the shortest interval",
       [](Parts& node) {
         node.pdos.tpdo.parameters.rules.inhibit_time.replace(
             [](const auto& former, const PdoParameters& pdo, std::int64_t value) {
               return former(pdo, (value + 99) / 100 * 100);
             });
       }},
      {"rpdo-length-at-sync", "the length of a synchronous RPDO is judged with the SYNC", "PDO-RX-06",
       [](Parts& node) { node.pdos.rpdo.choices.judged_at_sync = true; }},
      {"rpdo-too-long-reported", "an RPDO that is too long causes EMCY 8220h", "PDO-RX-07",
       [](Parts& node) { node.pdos.rpdo.choices.too_long_reported = true; }},
      {"1400-bit-30", "bit 30 of the COB-ID of an RPDO is set", "OD-1400-14: do not care",
       preset_with_node_id(0x1400, 1, 0x4000'0200)},
      {"1400-sub-4",
       "a compatibility entry 1400h:04",
       "OD-1400-19",
       compatibility_entry(0x1400),
       {},
       {"1400-subs"}},
      {"1800-sub-4",
       "a compatibility entry 1800h:04",
       "OD-1800-19",
       compatibility_entry(0x1800),
       {},
       {"1800-timers"}},
  };
}

}  // namespace refnode
