// SPDX-License-Identifier: Apache-2.0
// The high resolution time stamp (1013h, CiA 301, 7.5.2.16): microseconds, starting with 0 at every reset. A
// written time is where the clock goes on from.
#pragma once

#include <cstdint>

#include "device/device.hpp"

namespace refnode {

struct ClockRules {
  /// 1013h counts microseconds.
  Rule<std::int64_t(Duration elapsed)> ticks;
  ClockRules();
};

class HighResolutionClock {
 public:
  explicit HighResolutionClock(Device& device) : device_(&device) {}
  HighResolutionClock(const HighResolutionClock&) = delete;
  HighResolutionClock& operator=(const HighResolutionClock&) = delete;

  ClockRules rules;

  /// 1013h
  void add_objects();
  void bind();

  void on_reset();

 private:
  [[nodiscard]] std::uint32_t ticks() const;
  [[nodiscard]] std::uint32_t elapsed() const;

  Device* device_;
  std::uint32_t offset_ = 0;  ///< what the clock was set to, less what had elapsed then
  BusTime started_{};
};

}  // namespace refnode
