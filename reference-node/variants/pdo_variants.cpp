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

}  // namespace

VariantTable pdo_variants() {
  return {
      {"rpdo-event-driven-only", "RPDO types FEh and FFh only", "7.5.2.35: types are the device's",
       choose([](Choices& c) { c.rpdo.synchronous_types = false; })},
      {"tpdo-event-driven-only", "TPDO types FEh and FFh only", "7.5.2.37: types are the device's",
       choose([](Choices& c) { c.tpdo.synchronous_types = c.tpdo.remote_types = false; }), "tpdo-types"},
      {"tpdo-synchronous-only",
       "TPDO types 00h to F0h only, 01h by default",
       "7.5.2.37: types are the device's",
       both(preset(0x1800, 2, 1),
            choose([](Choices& c) { c.tpdo.event_types = c.tpdo.remote_types = false; })),
       "tpdo-types",
       {"sync", "1800-type-FE"}},
      {"rpdo-synchronous-only",
       "RPDO types 00h to F0h only, 01h by default",
       "7.5.2.35: types are the device's",
       both(preset(0x1400, 2, 1), choose([](Choices& c) { c.rpdo.event_types = false; })),
       {},
       {"sync", "rpdo-event-driven-only", "1400-type-FE"}},
      {"tpdo-remote-types-absent", "TPDO types FCh and FDh are refused", "7.5.2.37: types are the device's",
       choose([](Choices& c) { c.tpdo.remote_types = false; })},
      {.id = "tpdo-without-remote-frames",
       .summary = "remote frames are never answered, bit 30 cannot be cleared",
       .legal = "OD-1800-14",
       .how =
           [](Parts& node) {
             node.pdos.tpdo_cob_id_rules.choices.remote_frames = node.device.choices.tpdo.remote_types =
                 false;
           },
       .lacks = {"remote frames"}},
      {.id = "tpdo-change-no-event",
       .summary = "a change of mapped data is no event of a TPDO",
       .legal = "7.5.2.37: what an event is, the device and its profile say",
       .how = choose([](Choices& c) { c.tpdo.change_is_event = false; }),
       .lacks = {"tpdo on change"},
       .warns = {"PDO-TX-07", "PDO-TX-08"}},
      {.id = "tpdo-sent-empty",
       .summary = "a TPDO without mapped objects is sent without data",
       .legal = "PDO-MAP-20 tolerates it",
       .how = choose([](Choices& c) { c.tpdo.sent_empty = true; }),
       .excludes = {"pdo-unmapped-not-valid"},
       .warns = {"PDO-MAP-20"}},
      {.id = "pdo-unmapped-not-valid",
       .summary = "a PDO without mapped objects reads back as not valid",
       .legal = "PDO-MAP-20",
       .how = choose([](Choices& c) { c.rpdo.needs_mapping = c.tpdo.needs_mapping = true; }),
       .excludes = {"1600-empty", "1A00-empty"}},
      {"tpdo-initial", "a TPDO when Operational is entered", "PDO-TX-07, PDO-TX-08",
       choose([](Choices& c) { c.tpdo.initial_event = true; })},
      {"tpdo-at-first-sync", "a cyclic TPDO comes with the first SYNC", "PDO-TX-06",
       choose([](Choices& c) { c.tpdo.sends_at_first_sync = true; })},
      {"rpdo-too-long-reported", "an RPDO that is too long causes EMCY 8220h", "PDO-RX-07",
       choose([](Choices& c) { c.long_rpdo_reported = true; })},
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
