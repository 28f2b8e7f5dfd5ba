// SPDX-License-Identifier: Apache-2.0
// NMT slave (CiA 301, 7.3.2): commands on CAN-ID 000h, the state machine and the boot-up message.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "device/device.hpp"

namespace refnode {

enum class Reset : std::uint8_t { node, communication };

class NmtSlave {
 public:
  explicit NmtSlave(Device& device) : device_(&device) {}

  std::function<void(Reset)> on_reset;           ///< load power-on values, forget the past
  std::function<void()> on_boot_up;              ///< Pre-operational reached, boot-up message sent
  std::function<void(NmtState from)> on_change;  ///< any other state change

  /// A data frame on CAN-ID 000h.
  void on_command(const Frame& frame);
  void start_reset(Reset reset);
  void enter(NmtState state);
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const;

 private:
  [[nodiscard]] bool addressed(const Frame& frame) const;
  [[nodiscard]] bool obeys_reset() const;
  /// Start, stop and enter pre-operational.
  void obey(std::uint8_t command);

  Device* device_;
  std::optional<BusTime> boot_due_, restart_due_;
  std::deque<std::pair<BusTime, std::uint8_t>> commands_;  ///< taken, and when each takes effect
};

}  // namespace refnode
