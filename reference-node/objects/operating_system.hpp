// SPDX-License-Identifier: Apache-2.0
// A small operating system to talk to (CiA 301, 7.5.2.26 to 7.5.2.29): commands (1023h) with their mode
// (1024h), a debugger (1025h) and a prompt (1026h).
//
// Commands are text. "echo WORDS" replies with the words, "true" replies with nothing, whatever else is an
// error. Each takes 20 ms. The prompt echoes what it is given.
#pragma once

#include <deque>
#include <string_view>
#include <vector>

#include "device/device.hpp"

namespace refnode {

struct OperatingSystemChoices {
  AbortCode nothing_to_deliver = abort_code::no_data;  ///< no reply, no output
};

/// A record of command, status and reply.
class CommandInterpreter {
 public:
  struct Codes {
    std::uint8_t done, done_with_reply, error_with_reply;
  };
  CommandInterpreter(Device& device, const OperatingSystemChoices& choices, Codes codes)
      : device_(&device), choices_(&choices), codes_(codes), outcome_{codes.done, {}} {}

  void add_objects(std::uint16_t index, std::string_view name);

  void on_reset();
  /// 1024h: 00h execute the next command at once, 01h keep it, 02h execute those kept, 03h abandon all.
  [[nodiscard]] Accepted set_mode(std::uint64_t mode);

 private:
  struct Outcome {
    std::uint8_t status = 0;
    Bytes reply;
  };
  [[nodiscard]] Accepted take(ByteView command);
  void execute(std::string_view command);
  [[nodiscard]] bool busy() const { return device_->now < busy_until_; }
  [[nodiscard]] std::uint8_t status() const;
  [[nodiscard]] Upload reply() const;

  Device* device_;
  const OperatingSystemChoices* choices_;
  Codes codes_;
  bool keeps_commands_ = false;
  std::vector<Bytes> kept_;
  Bytes last_;
  Outcome outcome_;
  BusTime busy_until_{};
};

class OperatingSystem {
 public:
  explicit OperatingSystem(Device& device);
  OperatingSystem(const OperatingSystem&) = delete;
  OperatingSystem& operator=(const OperatingSystem&) = delete;

  OperatingSystemChoices choices;

  /// 1023h to 1026h
  void add_objects();

  void on_reset();

 private:
  void add_prompt();

  Device* device_;
  CommandInterpreter commands_;
  CommandInterpreter debugger_;
  std::deque<std::uint8_t> output_;
};

}  // namespace refnode
