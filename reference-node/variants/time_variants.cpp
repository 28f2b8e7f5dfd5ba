// SPDX-License-Identifier: Apache-2.0
// TIME and the high resolution time stamp.
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
       .lacks = {"time consumer"}},
      {.id = "1012-const",
       .summary = "TIME is never consumed, 1012h is constant",
       .legal = "OD-1012-03: a const entry",
       .how = access(0x1012, 0, Access::constant),
       .lacks = {"time consumer"}},
      {"1012-consuming", "TIME is consumed by default", "OD-1012-02: bits 31 and 30 are not judged",
       preset(0x1012, 0, 0x80000100)},
      {"1013-absent", "no high resolution time", "7.5.2.16: optional", absent({0x1013}), "1013"},
      {"1013-ro", "a high resolution time that cannot be set", "OD-1013-02: ro", read_only_clock, "1013"},
      {"1013-wo", "a high resolution time that can only be set", "OD-1013-03: wo",
       access(0x1013, 0, Access::wo), "1013"},
  };
}

}  // namespace refnode
