// SPDX-License-Identifier: Apache-2.0
// The kernel stamps frames with CLOCK_REALTIME, which anybody may set; deadlines need CLOCK_MONOTONIC. This
// converts the one into the other and notices when the clock was set.
#pragma once

#include <cstdint>
#include <optional>

#include "base/time.hpp"
#include "can/descriptor.hpp"

namespace conform::can {

class RealtimeStamps {
 public:
  /// BusTime 0 is the moment of construction.
  RealtimeStamps();
  [[nodiscard]] BusTime now() const;
  /// UTC of BusTime 0.
  [[nodiscard]] std::int64_t epoch_ns() const { return epoch_ns_; }
  /// Becomes readable when the clock is set; poll it and call check_clock() then. -1 when the kernel has
  /// none.
  [[nodiscard]] int watch_descriptor() const { return watch_.get(); }
  /// Adjusts to the clock if it has been set.
  void check_clock();
  /// A stamp taken between `previous` and `now`, in nanoseconds of CLOCK_REALTIME. The result lies between
  /// them, too: stamps from both sides of a step are told apart by which conversion is possible.
  [[nodiscard]] BusTime convert(std::int64_t realtime_ns, BusTime previous, BusTime now);
  /// The same without looking at the clock: nullopt when the stamp does not lie between the two.
  [[nodiscard]] std::optional<BusTime> convert_if_between(std::int64_t realtime_ns, BusTime first,
                                                          BusTime last) const {
    const BusTime time(Duration(realtime_ns - offset_ns_ - origin_ns_));
    return time >= first && time <= last ? std::optional(time) : std::nullopt;
  }
  /// Whether the clock was set since construction.
  [[nodiscard]] bool stepped() const { return steps_ > 0; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }

 private:
  void arm();
  [[nodiscard]] bool measure();

  std::int64_t origin_ns_;      // CLOCK_MONOTONIC of BusTime 0
  std::int64_t offset_ns_ = 0;  // CLOCK_REALTIME - CLOCK_MONOTONIC
  std::int64_t old_offset_ns_ = 0;
  std::int64_t epoch_ns_ = 0;
  std::uint64_t steps_ = 0;
  Descriptor watch_;
};

}  // namespace conform::can
