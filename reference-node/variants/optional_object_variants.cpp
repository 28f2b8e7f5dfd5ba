// SPDX-License-Identifier: Apache-2.0
// The optional objects 100Ch, 100Dh, 1013h and 1019h to 1029h: absent, constant, with fewer entries, with
// other abort codes.
#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

namespace {

/// A producer of the time stamp only: what it counts cannot be set.
void read_only_clock(Parts& parts) { access(0x1013, 0, Access::ro)(parts); }

/// Nothing is plugged in: sub-index 01h is there and holds nothing.
void no_modules(Parts& parts) {
  preset(0x1027, 0, 0)(parts);
  parts.device.dictionary.remove_sub(0x1027, 2);
  if (Entry* entry = parts.device.dictionary.entry(0x1027, 1))
    entry->read = []() -> Upload { return refuse(abort_code::no_data); };
}

void empty_description(Parts& parts) {
  if (Entry* entry = parts.device.dictionary.entry(0x1021, 0))
    entry->read = []() -> Upload { return refuse(abort_code::no_data); };
}

/// The prompt reads as 00h when there is nothing to read.
void silent_prompt(Parts& parts) {
  for (const std::uint8_t sub : {std::uint8_t{2}, std::uint8_t{3}}) {
    Entry* entry = parts.device.dictionary.entry(0x1026, sub);
    if (entry == nullptr) continue;
    entry->read = [read = entry->read]() -> Upload {
      Upload value = read();
      return value ? value : Upload(Bytes{0});
    };
  }
}

}  // namespace

VariantTable optional_object_variants() {
  return {
      {.id = "guarding-absent",
       .summary = "neither node guarding nor life guarding",
       .legal = "7.2.8.2.2.1: heartbeat or guarding",
       .how = absent({0x100C, 0x100D}),
       .group = "guarding",
       .lacks = {"node guarding", "life guarding"}},
      {.id = "1017-absent",
       .summary = "is guarded and produces no heartbeat",
       .legal = "7.2.8.2.2.1: heartbeat or guarding",
       .how = absent({0x1017}),
       .group = "guarding",
       .excludes = {"1017"},
       .lacks = {"heartbeat producer"}},
      {.id = "life-guarding-absent",
       .summary = "is guarded and does not watch the guarding",
       .legal = "OD-100C-03: both entries read-only",
       .how = both(access(0x100C, 0, Access::ro), access(0x100D, 0, Access::ro)),
       .group = "guarding",
       .lacks = {"life guarding"}},
      {.id = "guarding-preset",
       .summary = "a life time of 20 s by default",
       .legal = "OD-100C-04, tolerated: a profile-specific default",
       .how = both(preset(0x100C, 0, 10000), preset(0x100D, 0, 2)),
       .group = "guarding",
       .warns = {"OD-100C-04"}},
      {"1013-absent", "no high resolution time", "7.5.2.16: optional", absent({0x1013}), "1013"},
      {"1013-ro", "a high resolution time that cannot be set", "OD-1013-02: ro", read_only_clock, "1013"},
      {"1013-wo", "a high resolution time that can only be set", "OD-1013-03: wo",
       access(0x1013, 0, Access::wo), "1013"},
      {.id = "1019-absent",
       .summary = "no SYNC counter",
       .legal = "7.5.2.22: optional",
       .how = absent({0x1019}),
       .group = "1019",
       .lacks = {"sync counter"}},
      {"1019-const", "SYNC never has a counter", "OD-1019-08: const", access(0x1019, 0, Access::constant),
       "1019"},
      {"abort-1019-reserved-0800-0000", "a reserved counter overflow: general error", "OD-1019-04",
       [](Parts& node) { node.sync.choices.counter_reserved = abort_code::general_error; }},
      {"abort-1019-locked-0800-0000", "a counter overflow in use: general error", "OD-1019-05",
       [](Parts& node) { node.sync.choices.counter_locked = abort_code::general_error; }},
      {"1020-absent", "no configuration date", "7.5.2.23: optional", absent({0x1020})},
      {"1021-absent", "no device description inside", "7.5.2.24: optional", absent({0x1021, 0x1022}), "1021"},
      {"1021-empty", "no device description has been stored yet", "OD-1021-01: an empty store",
       empty_description, "1021"},
      {"1022-own-format", "the device description in a format of the manufacturer", "OD-1022-02: 80h to FFh",
       preset(0x1022, 0, 0x80)},
      {"os-absent", "no operating system", "7.5.2.26 to 7.5.2.29: optional",
       absent({0x1023, 0x1024, 0x1025, 0x1026}), "os"},
      {"os-commands-only", "neither command mode nor debugger nor prompt", "7.5.2.27 to 7.5.2.29: optional",
       absent({0x1024, 0x1025, 0x1026}), "os"},
      {"os-command-wo", "commands cannot be read back", "OD-1023-04, OD-1025-04: wo",
       both(access(0x1023, 1, Access::wo), access(0x1025, 1, Access::wo))},
      {"os-stderr-absent", "no StdErr", "OD-1026-03: optional", absent_from(0x1026, 3)},
      {"os-prompt-reads-0", "a prompt without output reads as 00h", "OD-1026-03: one byte", silent_prompt},
      {.id = "abort-os-nothing-0800-0000",
       .summary = "nothing to deliver: general error",
       .legal = "OD-1023-01, OD-1025-01, OD-1026-03",
       .how =
           [](Parts& node) { node.operating_system.choices.nothing_to_deliver = abort_code::general_error; },
       .warns = {"OD-GEN-11"}},
      {.id = "1027-absent",
       .summary = "not modular",
       .legal = "7.5.2.30: for modular devices",
       .how = absent({0x1027}),
       .group = "1027",
       .lacks = {"modular device"}},
      {"1027-no-modules", "a modular device without modules", "OD-1027-01: 00h", no_modules, "1027"},
      {.id = "1028-absent",
       .summary = "consumes no EMCY",
       .legal = "7.5.2.31: optional",
       .how = absent({0x1028, 0x2F11}),
       .group = "1028",
       .lacks = {"emcy consumer"}},
      {"1028-one", "consumes the EMCY of node 1", "7.5.2.31: 01h to 7Fh", absent_from(0x1028, 2), "1028"},
      {"1028-gap", "consumes the EMCY of the nodes 1, 3 and 4", "OD-1028-03: gaps are tolerated",
       gap(0x1028, 2), "1028"},
      {"1028-const", "which EMCY are consumed is fixed", "OD-1028-08",
       access_all(0x1028, Access::rw, Access::constant), "1028"},
      {"abort-1028-bit-30-0609-0031", "reserved bit 30 of 1028h: value too high",
       "7.5.2.31: no code is named",
       [](Parts& node) { node.emergencies.cob_id_rules.choices.fixed_bit = abort_code::value_too_high; }},
      {.id = "1029-absent",
       .summary = "the error behaviour cannot be chosen",
       .legal = "7.5.2.32: optional",
       .how = absent({0x1029}),
       .group = "1029",
       .lacks = {"error behaviour"}},
      {"1029-communication-only", "an error behaviour for communication errors only",
       "7.5.2.32: 02h to FEh are optional", absent_from(0x1029, 2), "1029"},
      {"1029-const", "the error behaviour is fixed", "OD-1029-12", access(0x1029, 1, Access::constant),
       "1029"},
      {.id = "1029-stops",
       .summary = "a communication error stops the device by default",
       .legal = "OD-1029-04, tolerated: a profile-specific default",
       .how = preset(0x1029, 1, 2),
       .group = "1029",
       .warns = {"OD-1029-04"}},
  };
}

}  // namespace refnode
