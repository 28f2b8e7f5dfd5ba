// SPDX-License-Identifier: Apache-2.0
// A host or a bus in trouble: bus-off, steps of the clock, late frames, floods.
#include <atomic>

#include "bench.hpp"
#include "engine/recorder.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using namespace std::chrono_literals;
using result::Verdict;

namespace {

/// A transport whose host is in trouble from the given request on.
class UnwellTransport final : public can::Transport {
 public:
  using Trouble = std::function<void(can::BusHealth&)>;
  UnwellTransport(can::Transport& inner, std::uint8_t command, Trouble trouble)
      : inner_(inner), command_(command), trouble_(std::move(trouble)) {}
  BusTime now() const override { return inner_.now(); }
  Result<void> send(const can::Frame& frame) override {
    if (frame.id == 0x601 && frame.data[0] == command_) trouble_(health_);
    return inner_.send(frame);
  }
  Result<std::optional<can::BusEvent>> receive(BusTime deadline) override { return inner_.receive(deadline); }
  can::BusHealth health() override { return health_; }
  can::TransportInfo info() const override { return inner_.info(); }

 private:
  can::Transport& inner_;
  std::uint8_t command_;
  Trouble trouble_;
  can::BusHealth health_;
};

constexpr std::string_view held_and_broken = R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
        checks: T-MUST
      - upload: {object: 1000h:00}
        checks: T-OTHER
        expect: {value: 1}
  - id: b
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
        checks: T-MUST
)";

/// Two rules, one held and one broken, on a host in trouble.
Outcome play_unwell(const UnwellTransport::Trouble& trouble, std::string_view scenarios = held_and_broken) {
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  UnwellTransport transport(bus.transport(), 0x2B, trouble);
  const auto suite = suite_of(std::string(scenarios));
  Outcome out;
  out.run = run(transport, device::default_profile(NodeId(1)), suite, catalogue(), {}, out.capture);
  return out;
}

/// A host that stands still in its first wait, until long behind its end, while frames come.
class StoppedTransport final : public can::Transport {
 public:
  explicit StoppedTransport(std::vector<can::BusEvent> events) : events_(std::move(events)) {}
  BusTime now() const override { return now_; }
  Result<void> send(const can::Frame&) override { return {}; }
  Result<std::optional<can::BusEvent>> receive(BusTime deadline) override {
    now_ = std::max(now_, std::exchange(stands_still_, false) ? deadline + 1s : deadline);
    if (next_ == events_.size() || events_[next_].time > deadline) return std::nullopt;
    return events_[next_++];
  }
  can::BusHealth health() override { return {}; }
  can::TransportInfo info() const override { return {}; }

 private:
  std::vector<can::BusEvent> events_;
  std::size_t next_ = 0;
  bool stands_still_ = true;
  BusTime now_{};
};

}  // namespace

TEST_CASE("what came within a wait is found, however long the host stood still in it") {
  can::Frame frame;
  frame.id = 0x080;
  StoppedTransport transport({{frame, BusTime(30ms)}, {frame, BusTime(90ms)}, {frame, BusTime(110ms)}});
  const std::atomic<int> nobody_stops = 0;
  Recorder recorder(transport, &nobody_stops);
  std::size_t found = 0;
  for (std::size_t from = 0; found < 9; ++found) {
    const auto next = recorder.find(from, [](const can::CapturedFrame&) { return true; }, BusTime(100ms));
    REQUIRE(next.has_value());
    if (!*next) break;
    from = **next + 1;
  }
  CHECK(found == 2);
}

TEST_CASE("every bus-off and every step of the clock is noticed, not only the first") {
  const auto first = [](const Outcome& out) { return out.run.cases[0].verdict; };
  const auto second = [](const Outcome& out) { return out.run.cases[1].verdict; };
  const auto off = play_unwell([](can::BusHealth& health) {
    health.bus_off = true;
    ++health.bus_offs;
  });
  CHECK(first(off) == Verdict::inconclusive);
  CHECK(second(off) == Verdict::inconclusive);
  const auto stepped = play_unwell([](can::BusHealth& health) {
    health.clock_stepped = true;
    ++health.clock_steps;
  });
  CHECK(first(stepped) == Verdict::inconclusive);
  CHECK(second(stepped) == Verdict::inconclusive);
}

TEST_CASE("an interface that held a frame back leaves open what the device did meanwhile") {
  const auto out = play_unwell([](can::BusHealth& health) { ++health.transmit_stalls; });
  CHECK(out.run.cases[0].verdict == Verdict::inconclusive);
  CHECK(out.run.cases[1].verdict == Verdict::inconclusive);
}

TEST_CASE("a host that was late is no excuse for a value that was read, and what it saw in time stays") {
  const auto out = play_unwell([](can::BusHealth& health) { ++health.late_frames; });
  CHECK(out.verdict_of("T-MUST") == Verdict::pass);
  CHECK(out.verdict_of("T-OTHER") == Verdict::fail);
  CHECK(out.run.cases[0].verdict == Verdict::fail);
  CHECK(out.run.cases[1].verdict == Verdict::pass);
}

TEST_CASE("a host that was late blames nobody where a step waits, nor behind it") {
  const auto out = play_unwell([](can::BusHealth& health) { ++health.late_frames; }, R"(
  - id: waits
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
      - wait: 1 ms
      - upload: {object: 1000h:00}
        checks: T-OTHER
        expect: {value: 1}
  - id: silent
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
      - frame: {id: heartbeat, within: 10 ms}
        checks: T-MUST
  - id: before
    title: t
    risk: config
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
        expect: {value: 1}
      - download: {object: 1017h:00, value: 1000}
      - wait: 1 ms
)");
  REQUIRE(out.run.cases.size() >= 3);
  CHECK(out.run.cases[0].verdict == Verdict::inconclusive);
  CHECK(out.run.cases[1].verdict == Verdict::inconclusive);
  CHECK(out.run.cases[2].verdict == Verdict::fail);
}

TEST_CASE("a flooded bus ends the run before the memory does, and values are put back") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  Recorder recorder(bus.transport(), nullptr, 10);
  for (int i = 0; i < 5; ++i)
    CHECK(recorder.send(can::data_frame(CanId(0x601), {0x40, 0, 0x10, 0, 0, 0, 0, 0})).has_value());
  const auto waited = recorder.wait_until(recorder.now() + 10ms);
  REQUIRE(waited.has_value() == (recorder.capture().size() < 10));
  const auto sent = recorder.send(can::data_frame(CanId(0x601), {0x40, 0, 0x10, 0, 0, 0, 0, 0}));
  REQUIRE_FALSE(sent.has_value());
  CHECK(recorder.fault()->what == flooded);
  recorder.ignore_stop(true);
  CHECK(recorder.send(can::data_frame(CanId(0x601), {0x40, 0, 0x10, 0, 0, 0, 0, 0})).has_value());
}

TEST_CASE("a cyclic frame that the host sends late is told, the first one is not") {
  /// Wakes up late: what a starved host does.
  class LateTransport final : public can::Transport {
   public:
    explicit LateTransport(can::Transport& inner) : inner_(inner) {}
    BusTime now() const override { return inner_.now(); }
    Result<void> send(const can::Frame& frame) override { return inner_.send(frame); }
    Result<std::optional<can::BusEvent>> receive(BusTime deadline) override {
      return inner_.receive(deadline + late);
    }
    can::BusHealth health() override { return inner_.health(); }
    can::TransportInfo info() const override { return inner_.info(); }
    Duration late{};

   private:
    can::Transport& inner_;
  };
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  LateTransport transport(bus.transport());
  Recorder recorder(transport, nullptr);
  recorder.produce({"heartbeat", can::data_frame(CanId(0x77E), {5}), 50ms, std::nullopt});
  REQUIRE(recorder.wait_until(recorder.now() + 500ms).has_value());
  CHECK(recorder.take_lateness().producing == Duration(0));
  transport.late = 40ms;
  REQUIRE(recorder.wait_until(recorder.now() + 500ms).has_value());
  const auto lateness = recorder.take_lateness();
  CHECK(lateness.producing == Duration(40ms));
  CHECK(lateness.waking == Duration(40ms));
  // Frames that only load the bus may come in a bunch.
  recorder.stop_producing("heartbeat");
  steps::Production load{"load", can::data_frame(CanId(0x7DF), {}), 1ms, std::nullopt};
  load.keeps_time = false;
  recorder.produce(load);
  REQUIRE(recorder.wait_until(recorder.now() + 500ms).has_value());
  CHECK(recorder.take_lateness().producing == Duration(0));
}

TEST_CASE("the last cyclic frame of a few is not late because nothing was sent before it") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  Recorder recorder(bus.transport(), nullptr);
  CHECK(recorder.send(can::data_frame(CanId(0x601), {0x40, 0, 0x10, 0, 0, 0, 0, 0})).has_value());
  recorder.produce({"sync", can::data_frame(CanId(0x80), {}), 150ms, 3});
  REQUIRE(recorder.wait_until(recorder.now() + 500ms).has_value());
  CHECK(recorder.late_sendings() == 0);
  CHECK(recorder.take_lateness().waking == Duration(0));
}

TEST_CASE("A frame that waits for a full bus is not late") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  Recorder recorder(bus.transport(), nullptr);
  // At 500 kbit/s 600 frames take more than host_is_late.
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.id == 0x601)
      for (int i = 0; i < 600; ++i) self.send(can::data_frame(CanId(0x281), {1, 2, 3, 4, 5, 6, 7, 8}));
    return true;
  };
  REQUIRE(recorder.send(can::data_frame(CanId(0x601), {0x40, 0, 0x10, 0, 0, 0, 0, 0})));
  REQUIRE(recorder.wait_until(recorder.now() + 1ms));
  REQUIRE(recorder.send(can::data_frame(CanId(0x77E), {5})));
  CHECK(recorder.capture().frames().back().time - recorder.capture().frames().front().time >
        can::host_is_late);
  CHECK(recorder.late_sendings() == 0);
}

TEST_CASE("A produced SYNC may count in its data") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  Recorder recorder(bus.transport(), nullptr);
  recorder.produce({"sync", can::data_frame(CanId(0x80), {1}), 10ms, 5, 3});
  REQUIRE(recorder.wait_until(recorder.now() + 100ms).has_value());
  std::vector<int> counts;
  for (const auto& captured : recorder.capture().frames()) counts.push_back(captured.frame.data[0]);
  CHECK(counts == std::vector<int>{1, 2, 3, 1, 2});
}

namespace {

/// Two measured seconds of a heartbeat that the device sends on its own.
constexpr std::string_view waits_for_heartbeat = R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
      - frame: {id: heartbeat, within: 10 ms}
        checks: T-MUST
)";

/// A device whose heartbeat follows the write at once in the tries of `heard`, on a machine that is late
/// while it waits for that.
Outcome play_on_busy_machine(const std::vector<bool>& heard, Duration late, bool is_virtual = true) {
  class BusyTransport final : public can::Transport {
   public:
    BusyTransport(can::Transport& inner, Duration late, bool is_virtual)
        : inner_(inner), late_(late), is_virtual_(is_virtual) {}
    BusTime now() const override { return inner_.now(); }
    Result<void> send(const can::Frame& frame) override { return inner_.send(frame); }
    Result<std::optional<can::BusEvent>> receive(BusTime deadline) override {
      return inner_.receive(deadline > inner_.now() ? deadline + late_ : deadline);
    }
    can::BusHealth health() override { return inner_.health(); }
    can::TransportInfo info() const override {
      auto out = inner_.info();
      out.is_virtual = is_virtual_;
      return out;
    }

   private:
    can::Transport& inner_;
    Duration late_;
    bool is_virtual_;
  };
  can::SimulatedBus bus;
  ScriptedDevice device;
  std::size_t tries = 0;
  device.before = [&](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    const bool is_try = frame.data[0] == 0x2B && frame.data[1] == 0x17 && frame.data[4] != 0;
    self.serve(frame);
    if (is_try && heard[std::min(tries++, heard.size() - 1)])
      self.send(can::data_frame(CanId(0x701), {0x7F}));
    return true;
  };
  bus.attach(device, "scripted device");
  BusyTransport transport(bus.transport(), late, is_virtual);
  const auto suite = suite_of(std::string(waits_for_heartbeat));
  Outcome out;
  out.run = run(transport, device::default_profile(NodeId(1)), suite, catalogue(), {}, out.capture);
  return out;
}

}  // namespace

TEST_CASE("a case that a late host left undecided is tried again, and its report says so") {
  int requests = 0;
  const auto out = play_unwell(
      [&requests](can::BusHealth& health) {
        if (++requests == 1) ++health.late_frames;
      },
      R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
      - frame: {id: heartbeat, within: 10 ms}
        checks: T-MUST
  - id: b
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
        checks: T-OTHER
)");
  CHECK(out.run.cases[0].verdict == Verdict::fail);  // in time, and silent all the same
  CHECK(out.run.cases[0].tried.starts_with("2 times"));
  CHECK(out.run.cases[1].tried.empty());
}

TEST_CASE(
    "what a busy machine may have done to its device is tried again, and fails when it comes each time") {
  const auto failed = play_on_busy_machine({false}, 15ms);
  CHECK(failed.verdict_of("T-MUST") == Verdict::fail);
  CHECK(failed.run.cases[0].tried.starts_with("4 times, with the same failure each time"));
  CHECK(play_on_busy_machine({true}, 15ms).run.cases[0].tried.empty());
}

TEST_CASE("a failure beside a busy machine that does not come again is neither a failure nor a pass") {
  const auto once = play_on_busy_machine({false, true}, 15ms);
  CHECK(once.verdict_of("T-MUST") == Verdict::inconclusive);
  CHECK(once.run.cases[0].tried.starts_with("2 times, and did not fail each time"));
  const auto last = play_on_busy_machine({false, false, false, true}, 15ms);
  CHECK(last.verdict_of("T-MUST") == Verdict::inconclusive);
}

TEST_CASE("a machine that is in time, or that the device does not share, excuses nothing") {
  const auto in_time = play_on_busy_machine({false, true}, 5ms);
  CHECK(in_time.verdict_of("T-MUST") == Verdict::fail);
  CHECK(in_time.run.cases[0].tried.empty());
  const auto apart = play_on_busy_machine({false, true}, 15ms, false);
  CHECK(apart.verdict_of("T-MUST") == Verdict::fail);
}

TEST_CASE("frames that wait in the queue when a loss comes to light belong to the time of the loss") {
  /// The host stood still once: its queue is full of another node's frames, the others are
  /// lost.
  class FullQueue final : public can::Transport {
   public:
    explicit FullQueue(can::Transport& inner) : inner_(inner) {}
    BusTime now() const override { return inner_.now(); }
    Result<void> send(const can::Frame& frame) override { return inner_.send(frame); }
    Result<std::optional<can::BusEvent>> receive(BusTime deadline) override {
      if (queued_.empty() || queued_.front().time > deadline) return inner_.receive(deadline);
      const auto out = queued_.front();
      queued_.erase(queued_.begin());
      return out;
    }
    can::BusHealth health() override {
      if (lost_) {
        ++health_.frames_dropped;
        const auto frame = can::data_frame(CanId(0x586), {0x35, 0x90});
        queued_.assign(3, {frame, inner_.now(), can::Direction::received});
        lost_ = false;
      }
      return health_;
    }
    can::TransportInfo info() const override { return inner_.info(); }
    void stand_still() { lost_ = health_.frames_dropped == 0; }

   private:
    can::Transport& inner_;
    std::vector<can::BusEvent> queued_;
    can::BusHealth health_;
    bool lost_ = false;
  };
  std::vector<std::string> problems;
  const auto rules = scenario::Catalogue::load(std::string(CONFORM_SOURCE_DIR) + "/suites", problems);
  REQUIRE(rules.has_value());
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  FullQueue transport(bus.transport());
  device.before = [&](ScriptedDevice&, const can::Frame& frame, BusTime) {
    // In the middle of the first case, behind its last frame.
    if (frame.data[0] == 0x40 && frame.data[1] == 0x18 && frame.data[3] == 4) transport.stand_still();
    return false;
  };
  const auto suite = suite_of(R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1018h:04}
        checks: SDO-UPL-01
        expect: [ok, abort any]
  - id: b
    title: t
    steps:
      - upload: {object: 1018h:01}
        checks: SDO-UPL-01
)",
                              *rules);
  auto profile = device::default_profile(NodeId(1));
  profile.claims.emplace("only node on the bus");
  can::Capture capture;
  const auto out = run(transport, profile, suite, *rules, {}, capture);
  const auto& frames = capture.frames();
  CHECK(std::ranges::count(frames, 0x586U, [](const auto& each) { return each.frame.id; }) == 3);
  const auto strange = std::ranges::find(out.cases, "monitor/can-ids", &result::CaseResult::id);
  REQUIRE(strange != out.cases.end());
  CHECK(strange->verdict == Verdict::inconclusive);
}
