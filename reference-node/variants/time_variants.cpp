// SPDX-License-Identifier: Apache-2.0
// TIME and the high resolution time stamp.
#include <chrono>

#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

namespace {

/// A producer of the time stamp only: what it counts cannot be set.
void read_only_clock(Parts& parts) { access(0x1013, 0, Access::ro)(parts); }

}  // namespace

VariantTable time_variants() {
  return {
      {.id = "1012-absent",
       .summary = "does not know TIME",
       .legal = "7.5.2.15: for devices that support TIME",
       .how = absent({0x1012, 0x2F10}),
       .group = "time",
       .lacks = {"time consumer", "time producer"}},
      {.id = "1012-const",
       .summary = "TIME is never consumed, 1012h is constant",
       .legal = "OD-1012-03: a const entry",
       .how = access(0x1012, 0, Access::constant),
       .lacks = {"time consumer", "time producer"}},
      {.id = "time-not-produced",
       .summary = "TIME is consumed only",
       .legal = "OD-1012-03: bit 30 of 1012h is refused",
       .how = [](Parts& node) { node.time.cob_id_rules.choices.produced = false; },
       .group = "time-producer",
       .lacks = {"time producer"}},
      {.id = "time-producer-unnamed",
       .summary = "TIME can be produced, and the profile does not say so",
       .legal = "7.5.2.15: bit 30 of 1012h shows it",
       .how = [](Parts&) {},
       .group = "time-producer",
       .lacks = {"time producer"}},
      {"time-at-once", "the first TIME when bit 30 of 1012h is set", "7.5.2.15: no period is said",
       [](Parts& node) { node.time_producer.choices.first_at_once = true; }},
      {"time-every-20-s", "TIME is sent every 20 s", "7.5.2.15: no period is said",
       [](Parts& node) { node.time_producer.choices.period = std::chrono::seconds(20); }, "time-period"},
      {"time-every-100-ms", "TIME is sent every 100 ms", "7.5.2.15: no period is said",
       [](Parts& node) { node.time_producer.choices.period = std::chrono::milliseconds(100); },
       "time-period"},
      {"time-of-an-own-clock", "a time that was received does not set the clock of the producer",
       "7.2.6: what the time is taken from is the device's to say",
       [](Parts& node) { node.time_producer.choices.goes_on_from_received = false; }, "time-clock"},
      {"time-always-from-12-35", "a clock of its own that begins at 12:35 with every production",
       "7.2.6: what the time is taken from is the device's to say",
       [](Parts& node) {
         node.time_producer.choices.goes_on_from_received = false;
         node.time_producer.choices.begins_at = std::chrono::minutes(12 * 60 + 35);
       },
       "time-clock"},
      {"1012-consuming", "TIME is consumed by default", "OD-1012-02: bits 31 and 30 are not judged",
       preset(0x1012, 0, 0x80000100)},
      {"1013-absent", "no high resolution time", "7.5.2.16: optional", absent({0x1013}), "1013"},
      {"1013-ro", "a high resolution time that cannot be set", "OD-1013-02: ro", read_only_clock, "1013"},
      {"1013-wo", "a high resolution time that can only be set", "OD-1013-03: wo",
       access(0x1013, 0, Access::wo), "1013"},
  };
}

}  // namespace refnode
