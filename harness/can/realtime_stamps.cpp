// SPDX-License-Identifier: Apache-2.0
#include "can/realtime_stamps.hpp"

#include <sys/timerfd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

namespace conform::can {
namespace {

// A new measurement of the offset differs from the old one by the time between two clock reads, which a busy
// machine can stretch. Below this it is noise, above it a step.
constexpr std::int64_t noise_ns = 1'000'000;

std::int64_t read_clock(clockid_t clock) {
  timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

// CLOCK_REALTIME - CLOCK_MONOTONIC. Of three attempts the one with the shortest gap between the clock reads
// counts.
std::int64_t read_offset() {
  std::int64_t best = 0;
  std::int64_t shortest = INT64_MAX;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const std::int64_t before = read_clock(CLOCK_MONOTONIC);
    const std::int64_t real = read_clock(CLOCK_REALTIME);
    const std::int64_t after = read_clock(CLOCK_MONOTONIC);
    if (after - before < shortest) {
      shortest = after - before;
      best = real - (before + (after - before) / 2);
    }
  }
  return best;
}

}  // namespace

RealtimeStamps::RealtimeStamps()
    : origin_ns_(read_clock(CLOCK_MONOTONIC)),
      watch_(::timerfd_create(CLOCK_REALTIME, TFD_NONBLOCK | TFD_CLOEXEC)) {
  arm();  // before measuring, so that no step falls between
  offset_ns_ = old_offset_ns_ = read_offset();
  epoch_ns_ = origin_ns_ + offset_ns_;
}

void RealtimeStamps::arm() {
  if (!watch_.valid()) return;
  // A timer that never expires: it only reports, as ECANCELED, that the clock was set.
  itimerspec far{};
  far.it_value.tv_sec = INT64_C(1) << 33U;
  static_cast<void>(
      ::timerfd_settime(watch_.get(), TFD_TIMER_ABSTIME | TFD_TIMER_CANCEL_ON_SET, &far, nullptr));
}

BusTime RealtimeStamps::now() const { return BusTime(Duration(read_clock(CLOCK_MONOTONIC) - origin_ns_)); }

bool RealtimeStamps::measure() {
  const std::int64_t measured = read_offset();
  const std::int64_t change = measured - offset_ns_;
  if (change > -noise_ns && change < noise_ns) return false;
  old_offset_ns_ = offset_ns_;
  offset_ns_ = measured;
  ++steps_;
  return true;
}

void RealtimeStamps::check_clock() {
  std::uint64_t expirations = 0;
  if (::read(watch_.get(), &expirations, sizeof expirations) < 0 && errno == ECANCELED) {
    arm();
    static_cast<void>(measure());
  }
}

BusTime RealtimeStamps::convert(std::int64_t realtime_ns, BusTime previous, BusTime now) {
  const auto with = [&](std::int64_t offset) { return BusTime(Duration(realtime_ns - offset - origin_ns_)); };
  const auto possible = [&](BusTime time) { return time >= previous && time <= now; };
  if (const BusTime time = with(offset_ns_); possible(time)) return time;
  if (const BusTime time = with(old_offset_ns_); possible(time)) return time;
  // Either the clock was set and nobody has told us yet, or two stamps are a hair out of order.
  const BusTime time = with(offset_ns_);
  if ((time > now + Duration(noise_ns) || time < previous - Duration(noise_ns)) && measure()) {
    if (const BusTime corrected = with(offset_ns_); possible(corrected)) return corrected;
  }
  return std::clamp(with(offset_ns_), previous, now);
}

}  // namespace conform::can
