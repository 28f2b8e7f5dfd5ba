// SPDX-License-Identifier: Apache-2.0
// What the client owes the device: time to follow its commands, and patience.
#include "bench.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using namespace std::chrono_literals;
using result::Verdict;

namespace {

/// A node that follows NMT commands late and sends a frame on 181h, its TPDO, for each SYNC in Operational.
class LateFollower final : public can::Participant {
 public:
  explicit LateFollower(Duration latency, bool beats = false) : latency_(latency), beats_(beats) {}

  void attach(Sender sender, BusTime) override { send_ = std::move(sender); }
  void on_frame(const can::Frame& frame, BusTime now) override {
    if (frame.is_data(CanId(0x000)) && frame.size() == 2 && frame.data[0] < 0x81) {
      commands_.emplace_back(now + latency_, frame.data[0]);
    } else if (frame.is_data(CanId(0x080)) && state_ == 0x01) {
      send_(can::data_frame(CanId(0x181), {0x55}));
    }
  }
  void on_time(BusTime now) override {
    while (!commands_.empty() && commands_.front().first <= now) {
      state_ = commands_.front().second;
      commands_.erase(commands_.begin());
      const std::uint8_t code = state_ == 0x01 ? 0x05 : state_ == 0x02 ? 0x04 : 0x7F;
      if (beats_) send_(can::data_frame(CanId(0x701), {code}));
    }
  }
  [[nodiscard]] std::optional<BusTime> next_wakeup() const override {
    return commands_.empty() ? std::nullopt : std::optional(commands_.front().first);
  }

 private:
  Duration latency_;
  bool beats_;
  std::uint8_t state_ = 0x80;
  std::vector<std::pair<BusTime, std::uint8_t>> commands_;
  Sender send_;
};

constexpr const char* sync_after_start = R"(
  - id: a
    title: t
    risk: motion
    steps:
      - nmt: start
      - send: {id: 80h, data: ""}
      - frame: {id: 181h, within: 10 ms}
        checks: T-MUST
      - nmt: stop
      - silence: {of: 181h, for: 50 ms}
        checks: T-OTHER
)";

Outcome play_late(LateFollower& follower, const std::string& scenarios) {
  can::SimulatedBus bus;
  bus.attach(follower, "late follower");
  ScriptedDevice device;
  return play(bus, device, scenarios);
}

/// From the first start command to the first SYNC.
Duration between_start_and_sync(const can::Capture& capture) {
  std::optional<BusTime> start;
  for (const auto& captured : capture.frames()) {
    if (captured.frame.is_data(CanId(0)) && captured.frame.data[0] == 0x01) start = captured.time;
    if (captured.frame.is_data(CanId(0x80)) && start) return captured.time - *start;
  }
  FAIL("no SYNC after a start");
  return {};
}

}  // namespace

TEST_CASE("a device has T_NMT to follow a command before it is asked for what the new state brings") {
  LateFollower follower(90ms);
  const auto out = play_late(follower, sync_after_start);
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(between_start_and_sync(out.capture) >= 100ms);
}

TEST_CASE("a heartbeat in the new state ends the wait for it") {
  LateFollower follower(20ms, true);
  const auto out = play_late(follower, sync_after_start);
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(between_start_and_sync(out.capture) < 30ms);
}

TEST_CASE("a heartbeat does not tell which of two commands in a row has been followed") {
  LateFollower follower(20ms, true);
  const auto out = play_late(follower, R"(
  - id: a
    title: t
    risk: motion
    steps:
      - nmt: stop
      - nmt: start
      - send: {id: 80h, data: ""}
      - frame: {id: 181h, within: 10 ms}
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(between_start_and_sync(out.capture) >= 100ms);
}

TEST_CASE("a step that says so does not wait for the state") {
  LateFollower follower(90ms);
  const auto out = play_late(follower, R"(
  - id: a
    title: t
    risk: motion
    steps:
      - nmt: start
      - send: {id: 80h, data: ""}
        at_once: true
      - silence: {of: 181h, for: 10 ms}
        at_once: true
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(between_start_and_sync(out.capture) < 5ms);
}

TEST_CASE("what a device sends before it has followed a stop is not held against it") {
  // The answer to the last SYNC in Operational comes when the stop is already on the bus.
  LateFollower follower(90ms);
  const auto out = play_late(follower, R"(
  - id: a
    title: t
    risk: motion
    steps:
      - nmt: start
      - wait: 150 ms
      - nmt: stop
      - send: {id: 80h, data: ""}
        at_once: true
        as: sync
      - silence: {of: 181h, for: 50 ms}
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::pass);
}
