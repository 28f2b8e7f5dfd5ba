// SPDX-License-Identifier: Apache-2.0
// The state a case begins in, and that nothing is sent or waited for on the way there that is not needed.
#include <algorithm>

#include "bench.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using namespace std::chrono_literals;
using result::Verdict;

namespace {

std::string fresh_case(const std::string& id, const std::string& kind) {
  return "  - id: " + id + "\n    title: t\n    risk: motion\n    fresh: " + kind + R"(
    steps:
      - upload: {object: 1017h:00}
        checks: T-MUST
)";
}

std::ptrdiff_t resets(const ScriptedDevice& device, std::uint8_t command) {
  return std::count(device.nmt.begin(), device.nmt.end(), command);
}

/// Tells its state once, a while after each command.
class Teller final : public can::Participant {
 public:
  explicit Teller(Duration delay) : delay_(delay) {}
  void attach(Sender sender, BusTime) override { send_ = std::move(sender); }
  void on_frame(const can::Frame& frame, BusTime now) override {
    if (!frame.is_data(CanId(0)) || frame.size() != 2) return;
    due_ = now + delay_;
    state_ = frame.data[0] == 0x80 ? 0x7F : frame.data[0] == 0x02 ? 0x04 : 0x05;
  }
  void on_time(BusTime now) override {
    if (!due_ || *due_ > now) return;
    due_.reset();
    send_(can::data_frame(CanId(0x701), {state_}));
  }
  [[nodiscard]] std::optional<BusTime> next_wakeup() const override { return due_; }

 private:
  Sender send_;
  Duration delay_;
  std::optional<BusTime> due_;
  std::uint8_t state_ = 0;
};

const std::string leave_operational = R"(
  - id: first
    title: t
    risk: motion
    steps:
      - nmt: start
      - upload: {object: 1000h:00}
        checks: T-MUST
      - wait: 200 ms
  - id: second
    title: t
    risk: motion
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
)";

}  // namespace

TEST_CASE("behind a case that only looked a device is still fresh, and is not reset again") {
  ScriptedDevice device;
  const auto out =
      play(device, fresh_case("a", "node") + fresh_case("b", "node") + fresh_case("c", "communication"));
  CHECK(resets(device, 0x81) == 1);
  CHECK(resets(device, 0x82) == 0);
  for (const auto& one : out.run.cases) CHECK(one.verdict == Verdict::pass);
}

TEST_CASE("a device that may have missed the command right behind its boot-up is told once more") {
  ScriptedDevice device;
  (void)play(device, fresh_case("a", "node"));
  const auto booted = std::ranges::find(device.nmt, std::uint8_t{0x81});
  CHECK(std::count(booted, device.nmt.end(), std::uint8_t{0x80}) >= 2);
}

TEST_CASE("a reset of the communication does not make the application fresh") {
  ScriptedDevice device;
  (void)play(device, fresh_case("a", "communication") + fresh_case("b", "node"));
  CHECK(resets(device, 0x82) == 1);
  CHECK(resets(device, 0x81) == 1);
}

TEST_CASE("whatever else was sent in between, a device that is to be fresh is reset") {
  for (const std::string step : {"download: {object: 1017h:00, value: current}", "nmt: start",
                                 "send: {id: 80h, data: \"\"}", "send: {id: 701h, rtr: true, dlc: 1}"}) {
    ScriptedDevice device;
    (void)play(device, fresh_case("a", "node") +
                           "  - id: between\n    title: t\n    risk: motion\n    steps:\n      - " + step +
                           "\n      - upload: {object: 1000h:00}\n        checks: T-OTHER\n" +
                           fresh_case("b", "node"));
    INFO(step);
    CHECK(resets(device, 0x81) == 2);
  }
}

TEST_CASE("a device that restarted by itself is not taken for one that was reset") {
  ScriptedDevice device;
  device.before = [seen = 0](ScriptedDevice& self, const can::Frame& frame, BusTime) mutable {
    // With the first look at 1017h of the first case.
    if (frame.data[0] == 0x40 && frame.data[1] == 0x17 && resets(self, 0x81) == 1 && seen++ == 0)
      self.send(can::data_frame(CanId(0x701), {0x00}));
    return false;
  };
  (void)play(device, fresh_case("a", "node") + fresh_case("b", "node"));
  CHECK(resets(device, 0x81) == 2);
}

TEST_CASE("a case begins as soon as a heartbeat shows Pre-operational, and after T_NMT where none does") {
  const auto pause = [](Duration until_told) {
    can::SimulatedBus bus;
    ScriptedDevice device;
    Teller teller(until_told);
    bus.attach(teller, "heartbeats of the device");
    const auto out = play(bus, device, leave_operational);
    REQUIRE(out.run.cases.size() == 2);
    return out.run.cases[1].begin - out.run.cases[0].end;
  };
  CHECK(pause(20ms) < 30ms);
  CHECK(pause(150ms) >= 100ms);
}

TEST_CASE("behind a reset a case begins after T_NMT, whatever a heartbeat shows") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  Teller teller(20ms);
  bus.attach(teller, "heartbeats of the device");
  const auto out = play(bus, device, fresh_case("a", "node"));
  std::optional<BusTime> booted;
  for (const auto& captured : out.capture.frames()) {
    if (captured.frame.is_data(CanId(0x701)) && captured.frame.data[0] == 0x00) booted = captured.time;
  }
  REQUIRE(booted);
  CHECK(out.only().begin - *booted >= 100ms);
}

TEST_CASE("in Stopped nobody is asked for an old value that is known") {
  ScriptedDevice device;
  std::vector<std::uint8_t> asked_in_stopped;
  device.before = [&](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    const bool stopped = !self.nmt.empty() && self.nmt.back() == 0x02;
    if (stopped) asked_in_stopped.push_back(frame.data[0]);
    return stopped;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: current}
      - nmt: stop
      - talk:
          object: 1017h:00
          frames: |
            > 600+N: 2B {m} E8 03 00 00
            silence 580+N for T_QUIET
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(asked_in_stopped == std::vector<std::uint8_t>{0x2B});
}
