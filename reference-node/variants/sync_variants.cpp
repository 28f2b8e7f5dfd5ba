// SPDX-License-Identifier: Apache-2.0
// SYNC, its counter and its window.
#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

VariantTable sync_variants() {
  return {
      {.id = "sync-absent",
       .summary = "no SYNC: 1005h to 1007h and 1019h absent, no synchronous PDO",
       .legal = "7.5.2.5: 1005h is for devices that support SYNC",
       .how = both(absent({0x1005, 0x1006, 0x1007, 0x1019}),
                   choose_of_pdos([](PdoChoices& c) { c.synchronous_types = c.remote_types = false; })),
       .group = "sync",
       .lacks = {"sync consumer", "sync counter"}},
      {"1006-1007-absent", "neither cycle period nor window length",
       "7.5.2.6, 7.5.2.7: for SYNC producers; optional", absent({0x1006, 0x1007})},
      {"1007-absent", "no synchronous window", "7.5.2.7: optional", absent({0x1007})},
      {"1005-bit-31", "default 8000 0080h", "OD-1005-02: bit 31 is not looked at",
       preset(0x1005, 0, 0x80000080)},
      {.id = "1005-const",
       .summary = "the COB-ID of SYNC cannot be changed",
       .legal = "OD-1005-06: 0601 0002h from a const entry",
       .how = access(0x1005, 0, Access::constant)},
      {.id = "sync-length-not-reported",
       .summary = "a SYNC with data causes no EMCY",
       .legal = "SYNC-CON-07; NMT-SVC-02 tolerates it",
       .how = [](Parts& node) { node.sync.choices.wrong_length_reported = false; },
       .warns = {"NMT-SVC-02", "SYNC-CON-05"}},
      {"sync-with-data-ignored", "a SYNC with data is not used", "SYNC-CON-07",
       [](Parts& node) { node.sync.choices.wrong_length_used = false; }},
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
  };
}

}  // namespace refnode
