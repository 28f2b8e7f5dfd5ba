// SPDX-License-Identifier: Apache-2.0
// What would make a verdict or the device untrustworthy: half restores, dirty channels, blame for what was
// not reached.
#include <csignal>

#include "bench.hpp"
#include "engine/run_session.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using namespace std::chrono_literals;
using result::Verdict;

namespace {

std::size_t count_of(const can::Capture& capture,
                     const std::function<bool(const can::CapturedFrame&)>& match) {
  return static_cast<std::size_t>(std::ranges::count_if(capture.frames(), match));
}

bool is_abort_of_ours(const can::CapturedFrame& captured) {
  return captured.direction == can::Direction::transmitted && captured.frame.id == 0x601 &&
         captured.frame.data[0] == 0x80;
}

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

}  // namespace

TEST_CASE("a stop request in the middle of restoring waits until the values are back") {
  ScriptedDevice device;
  std::atomic<int> stop{0};
  bool changed = false;
  device.before = [&](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    // The first look of the restore at the changed entry.
    if (changed && frame.data[0] == 0x40 && frame.data[1] == 0x17) stop = SIGINT;
    if (!self.writes.empty()) changed = true;
    return false;
  };
  RunOptions options;
  options.stop = &stop;
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
      - upload: {object: 1000h:00}
        checks: T-MUST
)",
                        options);
  CHECK(stop == SIGINT);
  CHECK(device.entries.at(0x101700) == std::vector<std::uint8_t>{0, 0});
  CHECK(out.run.signal == SIGINT);
}

TEST_CASE("a run stopped while a reset brings back what a test wrote puts it back all the same") {
  ScriptedDevice device;
  std::atomic<int> stop{0};
  // Stores by itself.
  device.on_reset = [&stop](ScriptedDevice& self) {
    if (self.writes.empty()) return;
    self.entries[0x101700] = {0xE8, 0x03};
    stop = SIGINT;
  };
  auto options = RunOptions{};
  options.stop = &stop;
  can::SimulatedBus bus;
  const auto out = play(bus, device, change_1017 + R"(
  - id: next
    title: t
    risk: config
    fresh: node
    steps:
      - upload: {object: 1017h:00}
        checks: T-MUST
)",
                        options);
  REQUIRE(out.run.cases.size() == 2);
  CHECK(out.run.cases[0].verdict == Verdict::pass);
  CHECK(out.run.cases[1].verdict == Verdict::error);
  CHECK(out.run.aborted == "stopped by the user");
  CHECK(device.entries.at(0x101700) == std::vector<std::uint8_t>{0, 0});
}

TEST_CASE("a run stopped while the device is in Stopped puts values back all the same") {
  ScriptedDevice device;
  std::atomic<int> stop{0};
  device.before = [&stop](ScriptedDevice& self, const can::Frame&, BusTime) {
    if (self.nmt.empty() || self.nmt.back() != 0x02) return false;
    stop = SIGINT;
    return true;
  };
  RunOptions options;
  options.stop = &stop;
  (void)play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
      - nmt: stop
      - upload: {object: 1000h:00}
        checks: T-MUST
        expect: silence
)",
             options);
  CHECK(device.entries.at(0x101700) == std::vector<std::uint8_t>{0, 0});
}

TEST_CASE("a stopped case is cleaned up, because only the scenario knows what it stored") {
  ScriptedDevice device;
  std::atomic<int> stop{0};
  device.entries[0x101000] = {1};
  device.entries[0x101001] = {1, 0, 0, 0};
  device.before = [&stop](ScriptedDevice& self, const can::Frame&, BusTime) {
    if (!self.writes.empty()) stop = SIGTERM;
    return false;
  };
  RunOptions options;
  options.stop = &stop;
  (void)play(device, R"(
  - id: a
    title: t
    risk: nvm
    steps:
      - download: {object: 1010h:01, value: 6576 6173h}
        checks: T-MUST
      - upload: {object: 1000h:00}
        checks: T-OTHER
    cleanup:
      - download: {object: 1010h:01, value: 1234 5678h}
)",
             options);
  CHECK(device.writes == std::vector<std::string>{"1010h = 73 61 76 65", "1010h = 78 56 34 12"});
}

TEST_CASE("an entry that no description names is put back as well") {
  ScriptedDevice device;
  device.entries[0x200000] = {7};
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 2000h:00, bytes: "09"}
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(device.entries.at(0x200000) == std::vector<std::uint8_t>{7});
}

TEST_CASE("a case begins with an idle channel, whatever the case before it left open") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: first
    title: t
    steps:
      - talk: |
          > 600+N: 40 00 10 00 00 00 00 00
          < 580+N: 43 00 10 00 91 01 00 00
        checks: T-MUST
  - id: second
    title: t
    steps:
      - talk: |
          > 600+N: 40 00 10 00 00 00 00 00
          < 580+N: 43 00 10 00 91 01 00 00
        checks: T-MUST
)");
  REQUIRE(out.run.cases.size() == 2);
  CHECK(out.run.cases[1].verdict == Verdict::pass);
  CHECK(count_of(out.capture, is_abort_of_ours) >= 1);
}

TEST_CASE("a conversation does not take a late answer for its own") {
  ScriptedDevice device;
  bool late = false;
  int seen = 0;
  device.before = [&late, &seen](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] == 0x80 && late) {
      late = false;
      self.send(can::data_frame(CanId(0x581), {0x4B, 0x17, 0x10, 0, 0x55, 0x55, 0, 0}));
      return true;
    }
    if (frame.data[1] != 0x17 || self.nmt.empty()) return false;
    late = ++seen == 3;  // discovery and snapshot read it before
    return late;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1017h:00}
        checks: T-MUST
      - talk: |
          > 600+N: 40 00 10 00 00 00 00 00
          < 580+N: 43 00 10 00 91 01 00 00
        checks: T-OTHER
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  CHECK(out.verdict_of("T-OTHER") == Verdict::pass);
}

TEST_CASE("up to the tier nvm a session sends nothing that is not for the device alone") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  Recorder recorder(bus.transport(), nullptr);
  auto profile = writing_profile();
  RunSession session(recorder, profile, device::dictionary_of(profile));
  const auto frame = [](std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
    return can::data_frame(CanId(id), bytes);
  };
  const can::Frame for_others[] = {
      frame(0x000, {0x01, 1}),  // start: outputs may move
      frame(0x000, {0x81, 0}),
      frame(0x000, {0x81, 2}),
      frame(0x000, {0x81}),
      frame(0x000, {0x07, 1}),
      frame(0x080, {}),
      frame(0x100, {0, 0, 0, 0, 0, 0}),
      frame(0x201, {1}),
      frame(0x77E, {5}),
      frame(0x602, {0x40, 0, 0x10, 0, 0, 0, 0, 0}),
      frame(0x6C0, {0x40, 0, 0x10, 0, 0, 0, 0, 0}),
      can::remote_frame(CanId(0x702), 1),
  };
  for (const auto risk : {scenario::Risk::config, scenario::Risk::nvm}) {
    session.begin_case(risk);
    const auto before = recorder.capture().size();
    for (const auto& each : for_others) {
      INFO(each.id << " " << hex_bytes(each.bytes()));
      CHECK_FALSE(session.send(each).has_value());
      CHECK_FALSE(session.produce({"x", each, std::chrono::milliseconds(10), 1}).has_value());
    }
    CHECK_FALSE(session.nmt(canopen::NmtCommand::start).has_value());
    CHECK(recorder.capture().size() == before);
    CHECK(session.send(can::remote_frame(CanId(0x701), 1)).has_value());
    CHECK(session.nmt(canopen::NmtCommand::stop).has_value());
  }
  session.begin_case(scenario::Risk::motion);
  for (const auto& each : for_others) CHECK(session.send(each).has_value());
}

TEST_CASE("from 2000h on only what the profile names is written, whatever the frame looks like") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  Recorder recorder(bus.transport(), nullptr);
  const auto profile = writing_profile();
  RunSession session(recorder, profile, device::dictionary_of(profile));
  session.begin_case(scenario::Risk::motion);
  const auto sends = [&session](std::initializer_list<std::uint8_t> bytes) {
    return session.send(can::data_frame(CanId(0x601), bytes)).has_value();
  };
  CHECK(sends({0x2F, 0x00, 0x20, 0, 9, 0, 0, 0}));
  CHECK_FALSE(sends({0x2F, 0x01, 0x20, 0, 9, 0, 0, 0}));
  CHECK_FALSE(sends({0x21, 0xFC, 0x4F, 0, 9, 0, 0, 0}));
  CHECK_FALSE(sends({0xC2, 0xFF, 0xFF, 0, 9, 0, 0, 0}));
  CHECK_FALSE(sends({0x2F, 0x01, 0x20}));
  CHECK(sends({0x40, 0x01, 0x20, 0, 0, 0, 0, 0}));
  CHECK_FALSE(
      session.download({Index(0x4FFC), SubIndex(0)}, {0}, canopen::SdoDownload::Mode::automatic, std::nullopt)
          .has_value());
  CHECK(session.is_writable({Index(0x4FFC), SubIndex(0)}).value_or(true) == false);
}

TEST_CASE("a session of read-only risk uploads and sends nothing else") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.attach(device, "scripted device");
  Recorder recorder(bus.transport(), nullptr);
  const auto profile = device::default_profile(NodeId(1));
  RunSession session(recorder, profile, device::dictionary_of(profile));
  session.begin_case(scenario::Risk::read_only);
  const Multiplexer entry{Index(0x1017), SubIndex(0)};
  CHECK(session.upload(entry, std::nullopt).has_value());
  CHECK_FALSE(
      session.download(entry, {1, 0}, canopen::SdoDownload::Mode::automatic, std::nullopt).has_value());
  CHECK_FALSE(session.is_writable(entry).has_value());
  CHECK_FALSE(session.nmt(canopen::NmtCommand::start).has_value());
  CHECK_FALSE(session.send(can::data_frame(CanId(0x080), {})).has_value());
  CHECK_FALSE(session.send(can::data_frame(CanId(0x601), {0x2B, 0x17, 0x10, 0, 1, 0, 0, 0})).has_value());
  CHECK_FALSE(session.send(can::data_frame(CanId(0x601), {0xC2, 0x17, 0x10, 0, 2, 0, 0, 0})).has_value());
  CHECK(session.send(can::data_frame(CanId(0x601), {0x40, 0x17, 0x10, 0, 0, 0, 0, 0})).has_value());
  CHECK(device.writes.empty());
  CHECK(device.nmt.empty());
}

TEST_CASE("a command is not written to find out whether it is writable") {
  ScriptedDevice device;
  device.entries[0x101000] = {1};
  device.entries[0x101001] = {1, 0, 0, 0};
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    when: 1010h:01 is writable
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(device.writes.empty());
}

TEST_CASE("alternatives of a set-up step of which none came stop the case") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1000h:00}
        either:
          - if: abort any
      - upload: {object: 1000h:00}
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::inconclusive);
  CHECK(out.only().setup_findings.size() == 1);
}

TEST_CASE("alternatives of a rule that only recommends warn when none came") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1000h:00}
        checks: T-SHOULD
        either:
          - if: abort any
)");
  CHECK(out.verdict_of("T-SHOULD") == Verdict::warn);
}

TEST_CASE("what is ruled out fails when nothing else is said") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
        fail: {value: 0000 0191h}
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
}

TEST_CASE("a requirement judged in part only has not passed when the case stops") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1000h:00}
        checks: [T-MUST, T-SHOULD]
      - upload: {object: 2345h:00}
      - upload: {object: 1000h:00}
        checks: T-MUST
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::inconclusive);
  CHECK(out.verdict_of("T-SHOULD") == Verdict::pass);
}

TEST_CASE("a range too long to walk over is not walked in part") {
  ScriptedDevice device;
  const auto walk = [](const std::string& range) {
    return R"(
  - id: a
    title: t
    steps:
      - let: {none: 0}
      - over: {value: [)" +
           range + R"(]}
        steps:
          - upload: {object: 1000h:00}
            checks: T-MUST
      - upload: {object: 1000h:00}
        checks: T-OTHER
)";
  };
  CHECK(play(device, walk("0..FFFF FFFFh")).only().verdict == Verdict::inconclusive);
  ScriptedDevice other;
  const auto empty = play(other, walk("1..$none - 1"));
  CHECK(empty.only().verdict == Verdict::pass);
  CHECK(empty.only().judgements.size() == 1);
}

TEST_CASE("the one finding of a walk shows the worst of its values") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] != 0x2B) return false;
    self.abort(frame, frame.data[4] == 1 ? 0x08000000 : 0x06010002);
    return true;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - over: {time: [1, 2]}
        steps:
          - download: {object: 1017h:00, value: $time}
            checks: T-MUST
            expect: abort 0609 0030h
            warn: abort 0800 0000h
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  REQUIRE(out.only().judgements.front().findings.size() == 1);
  CHECK(out.only().judgements.front().findings.front().verdict == Verdict::fail);
}

TEST_CASE("a failure seen before the device vanished stays, what its silence seems to show does not") {
  ScriptedDevice device;
  int reads = 0;
  device.before = [&reads](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] == 0x40 && frame.data[1] == 0x01 && frame.data[2] == 0x10 && ++reads == 3)
      self.dead = true;
    return self.dead;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1000h:00}
        checks: [T-MUST, T-SHOULD]
        expect: {value: 1}
      - upload: {object: 1018h:01}
        checks: T-OTHER
      - upload: {object: 1001h:00}
        checks: T-OTHER
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  CHECK(out.verdict_of("T-OTHER") == Verdict::error);
  CHECK(out.only().verdict == Verdict::fail);
  CHECK(result::exit_code(out.run) == 1);
}

TEST_CASE("a device whose heartbeats go on has not vanished when its SDO server dies") {
  ScriptedDevice device;
  bool hung = false;
  int reads = 0;
  device.before = [&](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] == 0x40 && frame.data[1] == 0x01 && frame.data[2] == 0x10 && ++reads == 3) hung = true;
    if (hung) self.send(can::data_frame(CanId(0x701), {0x7F}));
    return hung;
  };
  RunOptions options;
  options.plan.allowed = scenario::Risk::read_only;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1001h:00}
        checks: T-MUST
)",
                        options);
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  CHECK(out.run.aborted.has_value());
  CHECK(result::exit_code(out.run) == 1);
}

TEST_CASE("silence about an entry is not absence, and excuses from nothing") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice&, const can::Frame& frame, BusTime) {
    return frame.data[1] == 0x45 && frame.data[2] == 0x23;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    when: object 2345h is present
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::inconclusive);
  CHECK(out.verdict_of("T-MUST") == Verdict::inconclusive);
}

TEST_CASE("a device that falls silent during discovery ends the run at once") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[1] == 0x08 && frame.data[2] == 0x10) self.dead = true;
    return self.dead;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
)");
  CHECK(out.run.aborted.has_value());
  CHECK(out.run.elapsed < 25s);  // T_BOOT twice, and patience
  CHECK(result::exit_code(out.run) == 3);
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
