// SPDX-License-Identifier: Apache-2.0
// Other nodes of a network, as a device under test may meet them: heartbeats, PDOs, an EMCY now and then, and
// an SDO client at work with one of them. They neither command nor send SYNC or TIME.
#pragma once

#include <array>
#include <utility>

#include "can/participant.hpp"

namespace conform::cli {

class Neighbours final : public can::Participant {
 public:
  static constexpr std::uint8_t first_node = 0x33;
  static constexpr std::uint8_t second_node = 0x34;

  void attach(Sender sender, BusTime now) override {
    sender_ = std::move(sender);
    start_ = now;
    for (Task& task : tasks_) task.due = now + task.period;
  }
  void on_frame(const can::Frame&, BusTime) override {}
  void on_time(BusTime now) override {
    for (Task& task : tasks_) {
      if (task.due > now) continue;
      task.due += task.period;
      sender_(task.frame);
    }
  }
  [[nodiscard]] std::optional<BusTime> next_wakeup() const override {
    BusTime first = tasks_.front().due;
    for (const Task& task : tasks_) first = std::min(first, task.due);
    return first;
  }

 private:
  struct Task {
    Duration period;
    can::Frame frame;
    BusTime due{};
  };
  static Task every(int ms, std::uint32_t id, std::initializer_list<std::uint8_t> data) {
    return {std::chrono::milliseconds(ms), can::data_frame(CanId(id), data), {}};
  }

  Sender sender_;
  BusTime start_{};
  // Periods without a common divisor, so that they meet the device's frames at every distance.
  std::array<Task, 9> tasks_{{every(101, 0x733, {0x05}), every(503, 0x734, {0x7F}),
                              every(37, 0x1B3, {1, 2, 3, 4, 5, 6, 7, 8}), every(71, 0x233, {0x12, 0x34}),
                              every(211, 0x4B4, {0xFF, 0x00, 0xFF, 0x00}),
                              every(1013, 0x0B3, {0x00, 0xFF, 0x81, 0x00, 0x00, 0x00, 0x00, 0x00}),
                              every(149, 0x634, {0x40, 0x17, 0x10, 0x00, 0x00, 0x00, 0x00, 0x00}),
                              every(151, 0x5B4, {0x4B, 0x17, 0x10, 0x00, 0xF7, 0x01, 0x00, 0x00}),
                              every(907, 0x5B4, {0x80, 0x00, 0x20, 0x00, 0x00, 0x00, 0x02, 0x06})}};
};

}  // namespace conform::cli
