// SPDX-License-Identifier: Apache-2.0
// When a producer is due: heartbeat, SYNC, TIME.
#pragma once

#include <optional>

#include "device/device.hpp"

namespace refnode {

class Raster {
 public:
  void start(BusTime first) { next_ = first; }
  void stop() { next_.reset(); }
  [[nodiscard]] bool runs() const { return next_.has_value(); }
  [[nodiscard]] std::optional<BusTime> next() const { return next_; }

  /// Whether it is due now; the next time is then a period later. The raster is kept; only after a stall of
  /// more than a period it starts anew instead of catching up.
  /// @param jitter_percent  of the period, late and early by turns
  [[nodiscard]] bool due(BusTime now, Duration period, int jitter_percent = 0) {
    if (!next_ || now < *next_) return false;
    if (jitter_percent != 0) {
      late_ = !late_;
      period += (late_ ? period : -period) * jitter_percent / 100;
    }
    next_ = *next_ + period;
    if (*next_ <= now) next_ = now + period;
    return true;
  }

 private:
  std::optional<BusTime> next_;
  bool late_ = false;  ///< with jitter: the interval that runs is a long one
};

}  // namespace refnode
