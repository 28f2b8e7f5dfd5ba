// SPDX-License-Identifier: Apache-2.0
// Other values after power-on, and entries that cannot be changed.
#include <initializer_list>
#include <vector>

#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

namespace {

/// Device types of logical devices of the same profile, and FFFFh in the upper half of 1000h (CiA
/// 301, 7.5.2.1).
How logical_devices(std::initializer_list<std::uint16_t> described) {
  return [all = std::vector<std::uint16_t>(described)](Parts& parts) {
    preset(0x1000, 0, 0xFFFF0191)(parts);
    for (const std::uint16_t index : all) {
      parts.device.dictionary.add_variable(
          index, integer_entry("Device type", DataType::unsigned32, Access::ro, 0x00030191));
    }
  };
}

}  // namespace

VariantTable default_variants() {
  return {
      {"1000-additional-information", "another device type of the same profile", "OD-1000-03",
       preset(0x1000, 0, 0x00030191), "1000"},
      {.id = "logical-devices",
       .summary = "two logical devices, the second described at 6FFFh",
       .legal = "OD-1000-05: 67FFh + 1 * 800h",
       .how = logical_devices({0x6FFF}),
       .group = "1000",
       .gains = {"logical devices"}},
      {.id = "logical-devices-67ff",
       .summary = "two logical devices, both described",
       .legal = "OD-1000-05: 67FFh may be there",
       .how = logical_devices({0x67FF, 0x6FFF}),
       .group = "1000",
       .gains = {"logical devices"}},
      {.id = "1000-no-profile",
       .summary = "a device without a device profile",
       .legal = "OD-1000-03: profile number 0",
       .how = preset(0x1000, 0, 0),
       .group = "1000",
       .lacks = {"profile device"}},
      {"1005-bit-31", "default 8000 0080h", "OD-1005-02: bit 31 is not looked at",
       preset(0x1005, 0, 0x80000080)},
      {.id = "1005-const",
       .summary = "the COB-ID of SYNC cannot be changed",
       .legal = "OD-1005-06: 0601 0002h from a const entry",
       .how = access(0x1005, 0, Access::constant)},
      {.id = "1012-const",
       .summary = "TIME is never consumed, 1012h is constant",
       .legal = "OD-1012-03: a const entry",
       .how = access(0x1012, 0, Access::constant),
       .lacks = {"time consumer"}},
      {"1012-consuming", "TIME is consumed by default", "OD-1012-02: bits 31 and 30 are not judged",
       preset(0x1012, 0, 0x80000100)},
      {"1014-const", "the COB-ID of EMCY cannot be changed", "OD-1014-09",
       access(0x1014, 0, Access::constant)},
      {"1014-not-valid",
       "no EMCY by default",
       "OD-1014-02: bit 31 is not judged",
       preset_with_node_id(0x1014, 0, 0x80000080),
       "1014-default",
       {"1014-const"}},
      {.id = "1015-10ms",
       .summary = "an EMCY inhibit time of 10 ms by default",
       .legal = "OD-1015-02, tolerated: a profile-specific default",
       .how = preset(0x1015, 0, 100),
       .group = "1015",
       .warns = {"OD-1015-02"}},
      {.id = "1015-100ms",
       .summary = "an EMCY inhibit time of 100 ms by default",
       .legal = "OD-1015-02, tolerated: a profile-specific default",
       .how = preset(0x1015, 0, 1000),
       .group = "1015",
       .warns = {"OD-1015-02"}},
      {"1017-10ms", "a heartbeat every 10 ms by default", "OD-1017-02: declared default",
       preset(0x1017, 0, 10), "1017"},
      {"1017-50ms", "a heartbeat every 50 ms by default", "OD-1017-02: declared default",
       preset(0x1017, 0, 50), "1017"},
      {"1017-1s", "a heartbeat every second by default", "OD-1017-02: declared default",
       preset(0x1017, 0, 1000), "1017"},
      {"1017-const", "the heartbeat time is fixed to 100 ms", "7.5.2.20: rw or const",
       both(preset(0x1017, 0, 100), access(0x1017, 0, Access::constant)), "1017"},
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
       {"1400-const"}},
      {"1400-sub-2", "neither inhibit time nor event timer of the RPDO", "OD-1400-01: 02h to 05h",
       absent_from(0x1400, 3)},
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
       {"1800-const"}},
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
      {"1A00-const", "the mapping of the TPDO is fixed", "OD-1A00-04",
       access_all(0x1A00, Access::rw, Access::constant), "1A00"},
      {"1A00-empty", "nothing is mapped by default", "OD-1A00-01: 00h", preset(0x1A00, 0, 0), "1A00"},
      {"1A00-four", "four mapping entries", "OD-1A00-01: up to 40h", absent_from(0x1A00, 5), "1A00"},
      {.id = "pdo-mapping-const",
       .summary = "no mapping can be changed",
       .legal = "OD-1600-04, OD-1A00-04",
       .how = both(access_all(0x1600, Access::rw, Access::constant),
                   access_all(0x1A00, Access::rw, Access::constant)),
       .group = "1600",
       .excludes = {"1A00"},
       .lacks = {"variable mapping"}},
  };
}

}  // namespace refnode
