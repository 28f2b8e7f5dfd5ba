// SPDX-License-Identifier: Apache-2.0
#include "canopen/nmt.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/check.hpp"

namespace conform::canopen {
namespace {

constexpr std::array<std::pair<NmtCommand, std::string_view>, 5> commands{{
    {NmtCommand::start, "start"},
    {NmtCommand::stop, "stop"},
    {NmtCommand::pre_operational, "pre-operational"},
    {NmtCommand::reset_node, "reset node"},
    {NmtCommand::reset_communication, "reset communication"},
}};

constexpr std::array<std::pair<NmtState, std::string_view>, 4> states{{
    {NmtState::boot_up, "boot-up"},
    {NmtState::stopped, "stopped"},
    {NmtState::operational, "operational"},
    {NmtState::pre_operational, "pre-operational"},
}};

template <typename Table, typename Value>
std::string_view name_in(const Table& table, Value value) {
  const auto found = std::ranges::find(table, value, &Table::value_type::first);
  CONFORM_CHECK(found != table.end());
  return found->second;
}

template <typename Table>
auto value_in(const Table& table, std::string_view word)
    -> std::optional<typename Table::value_type::first_type> {
  const auto found = std::ranges::find(table, word, &Table::value_type::second);
  if (found == table.end()) return std::nullopt;
  return found->first;
}

template <typename Table>
auto defined_in(const Table& table, std::uint8_t code)
    -> std::optional<typename Table::value_type::first_type> {
  for (const auto& row : table) {
    if (static_cast<std::uint8_t>(row.first) == code) return row.first;
  }
  return std::nullopt;
}

}  // namespace

std::string_view to_string(NmtCommand command) { return name_in(commands, command); }
std::optional<NmtCommand> parse_nmt_command(std::string_view word) { return value_in(commands, word); }
std::optional<NmtCommand> nmt_command_at(std::uint8_t code) { return defined_in(commands, code); }

std::string_view to_string(NmtState state) { return name_in(states, state); }
std::optional<NmtState> parse_nmt_state(std::string_view word) { return value_in(states, word); }
std::optional<NmtState> nmt_state_at(std::uint8_t code) { return defined_in(states, code); }

can::Frame encode(NmtCommand command, NodeId node) {
  CONFORM_CHECK(node.value() >= 1 && node.value() <= 127);
  return can::data_frame(CanId{0}, {static_cast<std::uint8_t>(command), node.value()});
}

can::Frame encode_broadcast(NmtCommand command) {
  return can::data_frame(CanId{0}, {static_cast<std::uint8_t>(command), 0});
}

can::Frame encode_heartbeat(NodeId node, NmtState state) {
  CONFORM_CHECK(node.value() >= 1 && node.value() <= 127);
  return can::data_frame(CanId{0x700U + node.value()}, {static_cast<std::uint8_t>(state)});
}

std::optional<ErrorControl> decode_error_control(const can::Frame& frame, NodeId node) {
  if (!frame.is_data(CanId{0x700U + node.value()}) || frame.size() == 0) return std::nullopt;
  ErrorControl out;
  out.code = frame.data[0] & 0x7FU;
  out.toggle = (frame.data[0] & 0x80U) != 0;
  out.state = nmt_state_at(out.code);
  return out;
}

bool is_boot_up(const can::Frame& frame, NodeId node) {
  const auto message = decode_error_control(frame, node);
  return message && frame.dlc == 1 && message->is_boot_up();
}

}  // namespace conform::canopen
