// SPDX-License-Identifier: Apache-2.0
#include "time/high_resolution_clock.hpp"

#include <chrono>

namespace refnode {

ClockRules::ClockRules()
    : ticks([](Duration elapsed) -> std::int64_t {
        return std::chrono::duration_cast<std::chrono::microseconds>(elapsed).count();
      }) {}

void HighResolutionClock::add_objects() {
  device_->dictionary.add_variable(
      0x1013, integer_entry("High resolution time stamp", DataType::unsigned32, Access::rw, 0));
}

void HighResolutionClock::bind() {
  Entry* entry = device_->dictionary.entry(0x1013, 0);
  if (entry == nullptr || entry->type != DataType::unsigned32) return;
  entry->storable = false;
  entry->read = [this]() -> Upload { return conform::to_le(ticks(), 4); };
  entry->check = [this](ByteView bytes) -> Accepted {
    offset_ = static_cast<std::uint32_t>(conform::load_le(bytes)) - elapsed();
    return {};
  };
}

void HighResolutionClock::on_reset() {
  started_ = device_->now;
  offset_ = 0;
}

// 32 bits: the clock starts again after 71 minutes.
std::uint32_t HighResolutionClock::elapsed() const {
  return static_cast<std::uint32_t>(rules.ticks(device_->now - started_));
}

std::uint32_t HighResolutionClock::ticks() const { return elapsed() + offset_; }

}  // namespace refnode
