// SPDX-License-Identifier: Apache-2.0
#include "can/realtime_stamps.hpp"

#include <ctime>

#include "catch.hpp"

using namespace conform;
using namespace conform::can;
using namespace std::chrono_literals;

namespace {
std::int64_t realtime_ns() {
  timespec time{};
  ::clock_gettime(CLOCK_REALTIME, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}
}  // namespace

TEST_CASE("a kernel stamp lies where the monotonic clock was") {
  RealtimeStamps clock;
  const BusTime before = clock.now();
  const std::int64_t stamp = realtime_ns();
  const BusTime after = clock.now();
  const BusTime converted = clock.convert(stamp, before, after);
  CHECK(converted >= before);
  CHECK(converted <= after);
}

TEST_CASE("differences of stamps are kept exactly") {
  RealtimeStamps clock;
  const BusTime wide_past{-1h};
  const BusTime wide_future{1h};
  const std::int64_t stamp = clock.epoch_ns();
  CHECK(clock.convert(stamp, wide_past, wide_future) == BusTime{});
  CHECK(clock.convert(stamp + 123'456'789, wide_past, wide_future) == BusTime(123'456'789ns));
}

TEST_CASE("an impossible stamp is brought into its interval, so that time never goes back") {
  RealtimeStamps clock;
  CHECK(clock.convert(clock.epoch_ns() + 3'600'000'000'000, BusTime{1s}, BusTime{2s}) == BusTime{2s});
  CHECK(clock.convert(clock.epoch_ns() - 3'600'000'000'000, BusTime{1s}, BusTime{2s}) == BusTime{1s});
  CHECK(clock.convert(clock.epoch_ns() + 999'999'999, BusTime{1s}, BusTime{2s}) == BusTime{1s});
  CHECK_FALSE(clock.stepped());
}
