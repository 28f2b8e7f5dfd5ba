// SPDX-License-Identifier: Apache-2.0
// A participant made of lambdas, for tests of the bus.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "can/participant.hpp"
#include "can/transport.hpp"

namespace conform::can::testing {

class ScriptedParticipant final : public Participant {
 public:
  std::function<void(ScriptedParticipant&, const Frame&, BusTime)> when_frame;
  std::function<void(ScriptedParticipant&, BusTime)> when_time;
  std::function<void(ScriptedParticipant&, BusTime)> when_transmitted;
  std::optional<BusTime> wakeup;
  std::vector<std::pair<Frame, BusTime>> heard;

  void attach(Sender sender, BusTime now) override {
    sender_ = std::move(sender);
    attached_at = now;
  }
  void on_frame(const Frame& frame, BusTime now) override {
    heard.emplace_back(frame, now);
    if (when_frame) when_frame(*this, frame, now);
  }
  void on_transmitted(BusTime now) override {
    if (when_transmitted) when_transmitted(*this, now);
  }
  void on_time(BusTime now) override {
    if (when_time) {
      when_time(*this, now);
    } else {
      wakeup.reset();
    }
  }
  [[nodiscard]] std::optional<BusTime> next_wakeup() const override { return wakeup; }
  void send(const Frame& frame) { sender_(frame); }

  BusTime attached_at{};

 private:
  Sender sender_;
};

/// Answers every data frame on `request` with its bytes on `answer`.
inline void make_echo(ScriptedParticipant& participant, std::uint32_t request, std::uint32_t answer) {
  participant.when_frame = [request, answer](ScriptedParticipant& self, const Frame& frame, BusTime) {
    if (frame.is_data(CanId(request))) self.send(data_frame(CanId(answer), frame.bytes()));
  };
}

}  // namespace conform::can::testing
