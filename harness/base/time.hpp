// SPDX-License-Identifier: Apache-2.0
// Time belongs to the bus: every stamp and deadline is a point on the clock of one transport.
#pragma once

#include <chrono>

namespace conform {

using Duration = std::chrono::nanoseconds;

/// The clock of a transport. It cannot be read here: only Transport::now() tells the time.
struct BusClock {
  using rep = Duration::rep;
  using period = Duration::period;
  using duration = Duration;
  using time_point = std::chrono::time_point<BusClock>;
  static constexpr bool is_steady = true;
};

/// Nanoseconds since an origin that the transport chooses (Transport::info().epoch maps it to UTC).
using BusTime = BusClock::time_point;

}  // namespace conform
