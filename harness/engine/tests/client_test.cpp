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

/// A host on which answers overtake the echo of their request in the queue of the socket.
class OvertakingTransport final : public can::Transport {
 public:
  explicit OvertakingTransport(can::Transport& inner) : inner_(inner) {}
  BusTime now() const override { return inner_.now(); }
  Result<void> send(const can::Frame& frame) override { return inner_.send(frame); }
  Result<std::optional<can::BusEvent>> receive(BusTime deadline) override {
    if (kept_) return std::exchange(kept_, std::nullopt);
    auto event = inner_.receive(deadline);
    if (!event || !*event || (*event)->direction != can::Direction::transmitted) return event;
    auto next = inner_.receive((*event)->time + 2ms);
    if (!next || !*next) return event;
    // Stamps never run backwards.
    kept_ = *event;
    kept_->time = (*next)->time;
    return next;
  }
  can::BusHealth health() override { return inner_.health(); }
  can::TransportInfo info() const override { return inner_.info(); }

 private:
  can::Transport& inner_;
  std::optional<can::BusEvent> kept_;
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

TEST_CASE("an answer that overtakes the echo of its request is its answer") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  OvertakingTransport transport(bus.transport());
  const auto suite = suite_of(R"(
  - id: a
    title: t
    risk: config
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
        expect: {value: 0000 0191h}
      - talk: |
          > 600+N: 40 00 10 00 00 00 00 00
          < 580+N: 43 00 10 00 ..
          > 600+N: 40 18 10 01 00 00 00 00
          < 580+N: 43 18 10 01 ..
        checks: T-OTHER
)");
  can::Capture capture;
  const auto out = run(transport, device::default_profile(NodeId(1)), suite, catalogue(), {}, capture);
  REQUIRE(out.cases.size() == 1);
  INFO(out.cases[0].reason);
  CHECK(out.cases[0].verdict == Verdict::pass);
}

TEST_CASE("what was on the bus before a request is not its answer") {
  ScriptedDevice device;
  // Answers twice where 1000h is read.
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] == 0x40 && frame.data[1] == 0x00 && frame.data[2] == 0x10) self.serve(frame);
    return false;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - talk: |
          > 600+N: 40 00 10 00 00 00 00 00
          < 580+N: 43 00 10 00 ..
          silence 701 for 5 ms
          > 600+N: 40 18 10 01 00 00 00 00
          < 580+N: 43 18 10 01 ..
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::pass);
}

TEST_CASE("a device that takes longer than T_SDO for an answer is waited for, and from then on at once") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime now) {
    if (frame.data[0] != 0x40) return frame.data[0] == 0x80;
    auto answer = frame;
    answer.id = 0x581;
    answer.data = {0x43, frame.data[1], frame.data[2], frame.data[3], 0x91, 0x01, 0, 0};
    self.send_at(now + 1200ms, answer);
    return true;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - talk: |
          > 600+N: 40 00 10 00 00 00 00 00
          < 580+N: 43 00 10 00 91 01 00 00
        checks: T-MUST
      - upload: {object: 1018h:01}
        checks: T-OTHER
        expect: {value: 0000 0191h}
)");
  CHECK(out.only().verdict == Verdict::pass);
}

TEST_CASE("to learn how long an entry is leaves no transfer open") {
  ScriptedDevice device;
  bool open = false;
  device.entries[0x100800] = {};
  device.before = [&open](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    const auto command = frame.data[0];
    if (command == 0x80) open = false;
    if (command == 0x40 && std::exchange(open, false)) {
      self.abort(frame, 0x05040001);
      return true;
    }
    const bool of_name = frame.data[1] == 0x08 && frame.data[2] == 0x10;
    if (command == 0x40 && of_name) {
      open = true;
      self.send(can::data_frame(CanId(0x581), {0x41, 0x08, 0x10, 0x00, 0x10, 0x00, 0x00, 0x00}));
      return true;
    }
    // Segments: seven, seven and two bytes.
    if (command != 0x60 && command != 0x70) return false;
    self.send(can::data_frame(CanId(0x581), {static_cast<std::uint8_t>(command & 0x10U), 0x41, 0x41, 0x41,
                                             0x41, 0x41, 0x41, 0x41}));
    return true;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    given: {name: entries with type VISIBLE_STRING and readable and holding 16 bytes}
    steps:
      - talk: |
          > 600+N: 40 00 10 00 00 00 00 00
          < 580+N: 43 00 10 00 ..
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::pass);
}

TEST_CASE("a label sits on the request, so that what comes before the response counts") {
  ScriptedDevice device;
  // A TPDO, then the response.
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] == 0x2B) self.send(can::data_frame(CanId(0x181), {0x55}));
    return false;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
        as: written
      - upload: {object: 1000h:00}
      - frame: {id: 181h, within: 10 ms, after: written}
        as: came
        checks: T-MUST
      - silence: {of: 181h, for: 10 ms, after: came}
        checks: T-OTHER
)");
  CHECK(out.only().verdict == Verdict::pass);
}
