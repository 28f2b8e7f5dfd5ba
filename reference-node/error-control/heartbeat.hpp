// SPDX-License-Identifier: Apache-2.0
// Error control by heartbeat (CiA 301, 7.2.8.3.2.2): producer (1017h) and consumer (1016h).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "device/device.hpp"

namespace refnode {

class HeartbeatProducer {
 public:
  explicit HeartbeatProducer(Device& device) : device_(&device) {}

  /// Puts the service behind 1017h.
  void bind();
  /// The boot-up message has been sent; it counts as the first heartbeat.
  void on_boot_up();
  void on_reset() { next_.reset(); }
  /// 1017h has been written.
  void on_period_written();
  void on_state_change();
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const { return next_; }

 private:
  [[nodiscard]] Duration period() const;
  void transmit();

  Device* device_;
  std::optional<BusTime> next_;
  bool toggle_ = false;          ///< used by a defect only
  std::optional<BusTime> ends_;  ///< a defect only
  bool late_ = false;            ///< used by a variant only
};

class HeartbeatConsumer {
 public:
  explicit HeartbeatConsumer(Device& device) : device_(&device) {}

  std::function<void()> on_loss;  ///< error behaviour: what the node does when a producer is lost

  /// Puts the service behind the entries of 1016h: as many nodes as there are can be monitored.
  void bind();
  /// Whether 1016h:`sub` may take this value.
  [[nodiscard]] Accepted check(std::uint8_t sub, ByteView bytes) const;
  /// 1016h:`sub` has been written: its monitoring starts anew with the next heartbeat.
  void on_written(std::uint8_t sub);
  void on_reset();
  /// A data frame of one byte on 701h..77Fh.
  void on_heartbeat(std::uint8_t node, std::uint8_t state);
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const;

 private:
  struct Watch {
    std::optional<BusTime> due;  ///< empty until the first heartbeat, and after a loss
    bool lost = false;
  };
  [[nodiscard]] std::uint8_t entries() const { return static_cast<std::uint8_t>(watches_.size()); }
  [[nodiscard]] std::uint8_t node_of(std::uint64_t value) const;
  [[nodiscard]] Duration time_of(std::uint64_t value) const;
  void lose(std::uint8_t sub);
  [[nodiscard]] bool monitored(std::uint64_t value) const;
  [[nodiscard]] std::uint64_t value_of(std::uint8_t sub) const {
    return device_->dictionary.number(0x1016, sub);
  }

  Device* device_;
  std::vector<Watch> watches_;  ///< of 1016h:01 and so on
};

}  // namespace refnode
