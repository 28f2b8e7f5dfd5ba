// SPDX-License-Identifier: Apache-2.0
// Heartbeat producer (1017h; CiA 301, 7.2.8.3.2.2 and 7.5.2.20).
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "device/device.hpp"
#include "device/raster.hpp"

namespace refnode {

struct HeartbeatProducerChoices {
  bool at_once = false;             ///< the first right after 1017h was written, and after boot-up
  bool at_state_change = false;     ///< one more, while 1017h is not 0
  int jitter_percent = 0;           ///< late and early by turns
  bool first_early = false;         ///< the first after boot-up comes after half the period
  bool from_last = false;           ///< a new period counts from the last heartbeat
  bool restarts_at_change = false;  ///< with at_state_change: the period begins anew
  bool crosses_reset = false;       ///< the next is in the transmit buffer when a reset comes, and is sent
};

struct HeartbeatProducerRules {
  /// 1017h counts in milliseconds.
  Rule<Duration(std::int64_t value)> period{
      [](std::int64_t value) -> Duration { return std::chrono::milliseconds(value); }};
};

class HeartbeatProducer {
 public:
  explicit HeartbeatProducer(Device& device) : device_(&device) {}
  HeartbeatProducer(const HeartbeatProducer&) = delete;
  HeartbeatProducer& operator=(const HeartbeatProducer&) = delete;

  HeartbeatProducerChoices choices;
  HeartbeatProducerRules rules;

  /// 1017h
  void add_objects();
  /// A write of 1017h starts the heartbeat anew.
  void bind();

  void on_reset();
  /// The boot-up message has been sent; it counts as the first heartbeat.
  void on_boot_up();
  void on_state_change();
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const { return raster_.next(); }

 private:
  /// With the period that 1017h says now; 0: there is no heartbeat.
  void start();
  void on_written();
  void transmit();
  [[nodiscard]] conform::can::Frame message() const;

  Device* device_;
  conform::can::Frame waiting_{};  ///< what a heartbeat would have told last
  BusTime sent_{};                 ///< when the last one was
  Duration period_{};
  Raster raster_;
};

}  // namespace refnode
