// SPDX-License-Identifier: Apache-2.0
// PDOs: transmission types, remote frames and the first PDO.
#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

namespace {

/// Sub-index 04h as older devices have it: one byte, without meaning.
How compatibility_entry(std::uint16_t index) {
  return [index](Parts& parts) {
    if (parts.device.dictionary.objects().contains(index))
      parts.device.dictionary.add_sub(index, 4,
                                      integer_entry("Reserved", DataType::unsigned8, Access::rw, 0));
  };
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
      {"rpdo-event-driven-only", "RPDO types FEh and FFh only", "7.5.2.35: types are the device's",
       choose_of_rpdos([](PdoChoices& c) { c.synchronous_types = false; })},
      {"tpdo-event-driven-only", "TPDO types FEh and FFh only", "7.5.2.37: types are the device's",
       choose_of_tpdos([](PdoChoices& c) { c.synchronous_types = c.remote_types = false; }), "tpdo-types"},
      {"tpdo-synchronous-only",
       "TPDO types 00h to F0h only, 01h by default",
       "7.5.2.37: types are the device's",
       both(preset(0x1800, 2, 1),
            choose_of_tpdos([](PdoChoices& c) { c.event_types = c.remote_types = false; })),
       "tpdo-types",
       {"sync", "1800-type-FE"}},
      {"rpdo-synchronous-only",
       "RPDO types 00h to F0h only, 01h by default",
       "7.5.2.35: types are the device's",
       both(preset(0x1400, 2, 1), choose_of_rpdos([](PdoChoices& c) { c.event_types = false; })),
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
      {"rpdo-too-long-reported", "an RPDO that is too long causes EMCY 8220h", "PDO-RX-07",
       [](Parts& node) { node.pdos.rpdo.choices.too_long_reported = true; }},
      {"1400-bit-30", "bit 30 of the COB-ID of an RPDO is set", "OD-1400-14: do not care",
       preset_with_node_id(0x1400, 1, 0x4000'0200)},
      {"1400-sub-4",
       "a compatibility entry 1400h:04",
       "OD-1400-19",
       compatibility_entry(0x1400),
       {},
       {"1400-sub-2"}},
      {"1800-sub-4",
       "a compatibility entry 1800h:04",
       "OD-1800-19",
       compatibility_entry(0x1800),
       {},
       {"1800-sub-2"}},
  };
}

}  // namespace refnode
