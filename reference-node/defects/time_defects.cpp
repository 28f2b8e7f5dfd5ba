// SPDX-License-Identifier: Apache-2.0
// Defects of the high resolution time stamp (1013h); those of 1012h are with the other COB-IDs.
#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

constexpr DataType u16 = DataType::unsigned16;

ClockRules& of_clock(Parts& parts) { return parts.clock.rules; }

/// 1013h starts there after a reset; a time that is written is kept.
Change clock_starts_at(std::uint32_t start) {
  return together(reading(0x1013, 0,
                          [start](Parts&, const Read& former) -> Upload {
                            const Upload ticks = former();
                            if (!ticks) return ticks;
                            return conform::to_le(conform::load_le(*ticks) + start, ticks->size());
                          }),
                  checking(0x1013, 0, [start](Parts&, const Check& former, ByteView bytes) {
                    return former(conform::to_le(conform::load_le(bytes) - start, bytes.size()));
                  }));
}

}  // namespace

DefectTable time_defects() {
  return {
      {"1013-is-u16", "1013h has two bytes", {"OD-1013-01", "OD-LEN-04", "OD-GEN-17"}, type(0x1013, 0, u16)},
      {"1013-not-writable",
       "1013h is read-only although it is declared as writable",
       {"OD-1013-03", "OD-1013-02", "SDO-DNL-21"},
       access(0x1013, 0, Access::ro)},
      {"1013-write-ignored",
       "A time written to 1013h is confirmed and forgotten",
       {"OD-1013-03"},
       confirms(0x1013, 0, [](std::uint64_t) { return true; })},
      {"1013-default-nonzero",
       "1013h does not begin with 0 after a reset",
       {"OD-1013-04"},
       clock_starts_at(0x12345678)},
      {"1013-unit-ms",
       "1013h counts milliseconds",
       {"OD-1013-05"},
       decides(of_clock, &ClockRules::ticks,
               [](const auto& former, Duration elapsed) { return former(elapsed) / 1000; })},
  };
}

}  // namespace refnode
