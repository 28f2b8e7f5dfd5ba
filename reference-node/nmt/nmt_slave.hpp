// SPDX-License-Identifier: Apache-2.0
// NMT slave (CiA 301, 7.3.2): commands on CAN-ID 000h, the state machine and the boot-up message.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "device/device.hpp"

namespace refnode {

/// Table 37: command specifiers, the first byte of a command. The second is a node-ID, 0 for all nodes.
namespace nmt_command {
inline constexpr std::uint8_t start = 0x01;
inline constexpr std::uint8_t stop = 0x02;
inline constexpr std::uint8_t enter_pre_operational = 0x80;
inline constexpr std::uint8_t reset_node = 0x81;
inline constexpr std::uint8_t reset_communication = 0x82;
}  // namespace nmt_command

enum class Reset : std::uint8_t { node, communication };

/// CiA 301 gives no times. A device that starts by itself says so in its 1F80h (CiA 302-2).
struct NmtChoices {
  Duration node_start_up = std::chrono::milliseconds(20);
  Duration communication_start_up = std::chrono::milliseconds(5);
  Duration latency{};          ///< from start, stop or enter pre-operational to the new state
  bool self_starting = false;  ///< goes on into Operational after boot-up
};

struct NmtRules {
  /// From a reset to the boot-up message.
  Rule<Duration(Reset)> start_up_time;
  /// Without a node-ID there is no boot-up message: the start-up goes on until LSS gives one (CiA 305).
  Rule<bool(std::uint8_t node_id)> may_boot_up;
};

class NmtSlave {
 public:
  explicit NmtSlave(Device& device);
  NmtSlave(const NmtSlave&) = delete;
  NmtSlave& operator=(const NmtSlave&) = delete;

  NmtChoices choices;
  NmtRules rules;

  std::function<void(Reset)> on_reset;           ///< load power-on values, forget the past
  std::function<void()> on_boot_up;              ///< Pre-operational reached, boot-up message sent
  std::function<void(NmtState from)> on_change;  ///< any other state change

  /// A data frame on CAN-ID 000h.
  void on_command(const Frame& frame);
  void start_reset(Reset reset);
  void enter(NmtState state);
  void on_time();
  /// While the node starts up: when that ends.
  [[nodiscard]] std::optional<BusTime> boot_up_due() const { return boot_up_due_; }
  [[nodiscard]] std::optional<BusTime> next_wakeup() const;

 private:
  [[nodiscard]] bool addressed(const Frame& frame) const;
  /// Start, stop and enter pre-operational.
  void obey(std::uint8_t command);

  Device* device_;
  std::optional<BusTime> boot_up_due_;
  std::deque<std::pair<BusTime, std::uint8_t>> commands_;  ///< taken, and when each takes effect
};

}  // namespace refnode
