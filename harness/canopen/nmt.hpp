// SPDX-License-Identifier: Apache-2.0
// NMT node control and error control messages (CiA 301, 7.2.8).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/strong.hpp"
#include "can/frame.hpp"

namespace conform::canopen {

/// Command specifiers of node control (7.2.8.3.1).
enum class NmtCommand : std::uint8_t {
  start = 0x01,
  stop = 0x02,
  pre_operational = 0x80,
  reset_node = 0x81,
  reset_communication = 0x82,
};

[[nodiscard]] constexpr bool is_reset(NmtCommand command) {
  return command == NmtCommand::reset_node || command == NmtCommand::reset_communication;
}

/// "start", "stop", "pre-operational", "reset node", "reset communication": the words of scenarios.
[[nodiscard]] std::string_view to_string(NmtCommand command);
[[nodiscard]] std::optional<NmtCommand> parse_nmt_command(std::string_view word);
[[nodiscard]] std::optional<NmtCommand> nmt_command_at(std::uint8_t code);

/// States as error control messages carry them (7.2.8.3.2).
enum class NmtState : std::uint8_t {
  boot_up = 0x00,
  stopped = 0x04,
  operational = 0x05,
  pre_operational = 0x7F,
};

/// "boot-up", "stopped", "operational", "pre-operational".
[[nodiscard]] std::string_view to_string(NmtState state);
[[nodiscard]] std::optional<NmtState> parse_nmt_state(std::string_view word);
[[nodiscard]] std::optional<NmtState> nmt_state_at(std::uint8_t code);

/// The command for one node, which must not be 0: a command for all nodes needs encode_broadcast, so that it
/// cannot happen by mistake.
[[nodiscard]] can::Frame encode(NmtCommand command, NodeId node);
[[nodiscard]] can::Frame encode_broadcast(NmtCommand command);
/// A heartbeat of `node` as the harness produces it.
[[nodiscard]] can::Frame encode_heartbeat(NodeId node, NmtState state);

/// One byte on 700h + node-ID: boot-up message, heartbeat or guarding response.
struct ErrorControl {
  std::uint8_t code = 0;          ///< bits 0-6: the state as sent, legal or not
  bool toggle = false;            ///< bit 7: toggle bit of guarding, reserved in heartbeats
  std::optional<NmtState> state;  ///< the state, when `code` is one of the defined
  [[nodiscard]] bool is_boot_up() const { return code == 0 && !toggle; }
};

/// Decodes any data frame on 700h + `node` with at least one byte; nullopt for others. Check `dlc` apart: 1
/// is legal.
[[nodiscard]] std::optional<ErrorControl> decode_error_control(const can::Frame& frame, NodeId node);
/// The boot-up message of `node`, of the one byte it must have.
[[nodiscard]] bool is_boot_up(const can::Frame& frame, NodeId node);

}  // namespace conform::canopen
