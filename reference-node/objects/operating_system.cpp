// SPDX-License-Identifier: Apache-2.0
#include "objects/operating_system.hpp"

#include <chrono>
#include <string>

namespace refnode {

namespace {

constexpr std::uint8_t executing = 0xFF;
constexpr std::size_t longest_command = 64;
constexpr std::size_t most_kept_commands = 8;
constexpr std::size_t most_output = 256;
constexpr auto duration_of_a_command = std::chrono::milliseconds(20);

constexpr std::string_view first_command = "echo hello";

Bytes bytes_of(std::string_view text) { return Bytes(text.begin(), text.end()); }

}  // namespace

void CommandInterpreter::add_objects(std::uint16_t index, std::string_view name) {
  ObjectDictionary& od = device_->dictionary;
  od.add_complex(index, std::string(name), ObjectKind::record);
  last_ = bytes_of(first_command);
  Entry& command = od.add_sub(
      index, 1, bytes_entry("Command", DataType::octet_string, Access::rw, last_, longest_command));
  command.command = true;
  command.read = [this]() -> Upload { return last_; };
  command.check = [this](ByteView bytes) { return take(bytes); };
  od.add_sub(index, 2, integer_entry("Status", DataType::unsigned8, Access::ro, codes_.done)).read =
      [this]() -> Upload { return Bytes{status()}; };
  od.add_sub(index, 3, bytes_entry("Reply", DataType::octet_string, Access::ro, {})).read = [this] {
    return reply();
  };
}

void CommandInterpreter::on_reset() {
  keeps_commands_ = false;
  kept_.clear();
  last_ = bytes_of(first_command);
  outcome_ = {codes_.done, {}};
  busy_until_ = {};
}

Accepted CommandInterpreter::take(ByteView command) {
  if (busy()) return refuse(abort_code::device_state);
  if (keeps_commands_ && kept_.size() == most_kept_commands) return refuse(abort_code::general_error);
  last_.assign(command.begin(), command.end());
  if (keeps_commands_) {
    kept_.push_back(last_);
  } else {
    execute(std::string(last_.begin(), last_.end()));
  }
  return {};
}

Accepted CommandInterpreter::set_mode(std::uint64_t mode) {
  switch (mode) {
    case 0x00:
    case 0x01: keeps_commands_ = mode == 0x01; return {};
    case 0x02:
      for (const Bytes& command : kept_) execute(std::string(command.begin(), command.end()));
      kept_.clear();
      return {};
    case 0x03:
      kept_.clear();
      outcome_ = {codes_.done, {}};
      busy_until_ = device_->now;
      return {};
    default: return refuse(abort_code::invalid_value);
  }
}

void CommandInterpreter::execute(std::string_view command) {
  busy_until_ = std::max(busy_until_, device_->now) + duration_of_a_command;
  constexpr std::string_view echo = "echo ";
  if (command.starts_with(echo)) {
    outcome_ = {codes_.done_with_reply, bytes_of(command.substr(echo.size()))};
  } else if (command == "true") {
    outcome_ = {codes_.done, {}};
  } else {
    outcome_ = {codes_.error_with_reply, bytes_of("unknown command")};
  }
}

std::uint8_t CommandInterpreter::status() const { return busy() ? executing : outcome_.status; }

Upload CommandInterpreter::reply() const {
  if (busy() || outcome_.reply.empty()) return refuse(choices_->nothing_to_deliver);
  return outcome_.reply;
}

// The debugger knows but 00h and 01h beside FFh.
OperatingSystem::OperatingSystem(Device& device)
    : device_(&device),
      commands_(device, choices, {0x00, 0x01, 0x03}),
      debugger_(device, choices, {0x00, 0x00, 0x01}) {}

void OperatingSystem::add_objects() {
  commands_.add_objects(0x1023, "OS command");
  debugger_.add_objects(0x1025, "OS debugger interface");
  Entry& mode = device_->dictionary.add_variable(
      0x1024, integer_entry("OS command mode", DataType::unsigned8, Access::wo, 0));
  mode.command = true;
  mode.check = [this](ByteView bytes) { return commands_.set_mode(conform::load_le(bytes)); };
  add_prompt();
}

void OperatingSystem::add_prompt() {
  ObjectDictionary& od = device_->dictionary;
  od.add_complex(0x1026, "OS prompt", ObjectKind::array);
  Entry& input = od.add_sub(0x1026, 1, integer_entry("StdIn", DataType::unsigned8, Access::wo, 0));
  input.command = true;
  input.check = [this](ByteView bytes) -> Accepted {
    if (output_.size() == most_output) output_.pop_front();
    output_.push_back(bytes[0]);
    return {};
  };
  od.add_sub(0x1026, 2, integer_entry("StdOut", DataType::unsigned8, Access::ro, 0)).read =
      [this]() -> Upload {
    if (output_.empty()) return refuse(choices.nothing_to_deliver);
    const std::uint8_t next = output_.front();
    output_.pop_front();
    return Bytes{next};
  };
  od.add_sub(0x1026, 3, integer_entry("StdErr", DataType::unsigned8, Access::ro, 0)).read =
      [this]() -> Upload { return refuse(choices.nothing_to_deliver); };
}

void OperatingSystem::on_reset() {
  commands_.on_reset();
  debugger_.on_reset();
  output_.clear();
}

}  // namespace refnode
