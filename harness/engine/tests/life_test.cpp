// SPDX-License-Identifier: Apache-2.0
// Devices that start by themselves, need their time to start, hang, or are two.
#include <algorithm>

#include "bench.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using namespace std::chrono_literals;
using result::Verdict;

namespace {

const can::Frame boot_up = can::data_frame(CanId(0x701), {0x00});

bool reads(const can::Frame& frame, std::uint16_t index) {
  return frame.size() == 8 && frame.data[0] == 0x40 && frame.data[1] == (index & 0xFFU) &&
         frame.data[2] == index >> 8U;
}

/// Dead for a while, then it sends its boot-up message.
void restart(ScriptedDevice& device, BusTime now, Duration takes) {
  device.silent_until = now + takes;
  device.send_at(now + takes, boot_up);
}

device::Profile slow_starter(Duration boot_time) {
  auto profile = device::default_profile(NodeId(1));
  profile.boot_time = boot_time;
  return profile;
}

RunOptions read_only() {
  RunOptions options;
  options.plan.allowed = scenario::Risk::read_only;
  return options;
}

bool is_noted(const Outcome& out, const std::string& words) {
  return std::ranges::any_of(out.run.notes,
                             [&](const std::string& each) { return each.find(words) != std::string::npos; });
}

const std::string two_reads = R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1018h:01}
        checks: T-MUST
      - upload: {object: 2000h:00}
        checks: T-OTHER
  - id: b
    title: t
    steps:
      - upload: {object: 1018h:01}
        checks: T-MUST
)";

}  // namespace

TEST_CASE(
    "what was judged behind a restart that nobody asked for is open, what was judged before it stands") {
  for (const bool slow : {false, true}) {
    ScriptedDevice device;
    device.entries[0x200000] = {7};
    bool done = false;
    device.before = [&](ScriptedDevice& self, const can::Frame& frame, BusTime now) {
      if (done || !reads(frame, 0x2000)) return false;
      done = true;
      restart(self, now, slow ? Duration(8s) : Duration(200ms));
      return true;
    };
    can::SimulatedBus bus;
    const auto out = play(bus, device, two_reads, read_only(), slow_starter(10s));
    CHECK(out.verdict_of("T-MUST") == Verdict::pass);
    CHECK(out.verdict_of("T-OTHER") == Verdict::inconclusive);
    CHECK(out.verdict_of("T-MUST", 1) == Verdict::pass);
    CHECK_FALSE(out.run.aborted.has_value());
    CHECK(is_noted(out, "the device restarted once although nobody told it to"));
    CHECK(is_noted(out, "in test/a"));
    CHECK(device.nmt.empty());
  }
}

TEST_CASE("a rule that names crashes fails where the device restarts again upon the same frames") {
  for (const bool every_time : {false, true}) {
    ScriptedDevice device;
    bool done = false;
    device.before = [&](ScriptedDevice& self, const can::Frame& frame, BusTime now) {
      if (frame.data[0] != 0xE0 || (done && !every_time)) return false;
      done = true;
      restart(self, now, 200ms);
      return true;
    };
    const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - talk: |
          > 600+N: E0 00 00 00 00 00 00 00
          silence 580+N for T_QUIET
        checks: [T-CRASH, T-MUST]
)");
    CHECK(out.verdict_of("T-CRASH") == (every_time ? Verdict::fail : Verdict::inconclusive));
    CHECK(out.verdict_of("T-MUST") == Verdict::inconclusive);
    CHECK(is_noted(out, every_time ? "restarted 2 times" : "restarted once"));
  }
}

TEST_CASE("a start within T_BOOT is waited for, in every tier, also at the first probe and in the survey") {
  for (const bool may_command : {false, true}) {
    INFO(may_command);
    const auto options = may_command ? RunOptions{} : read_only();
    ScriptedDevice starting;
    starting.entries[0x200000] = {7};
    starting.silent_until = BusTime{} + 7s;
    starting.send_at(BusTime{} + 7s, boot_up);
    can::SimulatedBus bus;
    const auto late = play(bus, starting, two_reads, options, slow_starter(10s));
    CHECK(late.run.cases[0].verdict == Verdict::pass);
    CHECK(late.run.cases[1].verdict == Verdict::pass);

    ScriptedDevice surveyed;
    surveyed.entries[0x200000] = {7};
    bool done = false;
    surveyed.before = [&](ScriptedDevice& self, const can::Frame& frame, BusTime now) {
      if (done || !reads(frame, 0x1008)) return false;
      done = true;
      restart(self, now, 7s);
      return true;
    };
    can::SimulatedBus other;
    const auto in_survey = play(other, surveyed, two_reads, options, slow_starter(10s));
    CHECK(in_survey.run.cases[0].verdict == Verdict::pass);
    CHECK(is_noted(in_survey, "between cases"));
  }
}

TEST_CASE("a device that is starting and takes its time for answers is not mute") {
  // Two requests fall into the start, and then each answer comes after the time-out that a quick device
  // needs.
  ScriptedDevice device;
  device.entries[0x200000] = {7};
  device.silent_until = BusTime{} + 4900ms;
  device.latency = 1200ms;
  device.send_at(BusTime{} + 4900ms, boot_up);
  can::SimulatedBus bus;
  const auto out = play(bus, device, two_reads, RunOptions{}, slow_starter(5s));
  CHECK_FALSE(out.run.aborted.has_value());
  CHECK(out.verdict_of("T-MUST") == Verdict::pass);
  CHECK(out.verdict_of("T-OTHER") == Verdict::pass);
  CHECK(std::ranges::none_of(device.nmt, [](auto command) { return command >= 0x81; }));
}

TEST_CASE(
    "an entry that is never answered does not end the survey, also where reading it makes the device restart") {
  for (const bool restarts : {false, true}) {
    ScriptedDevice device;
    device.entries[0x200000] = {7};
    device.before = [restarts](ScriptedDevice& self, const can::Frame& frame, BusTime now) {
      if (!reads(frame, 0x1008)) return false;
      if (restarts) restart(self, now, 3s);
      return true;
    };
    can::SimulatedBus bus;
    const auto out = play(bus, device, two_reads, read_only(), slow_starter(5s));
    CHECK(out.run.cases[0].verdict == Verdict::pass);
    CHECK(is_noted(out, "requests for 1008h:00 are not answered"));
  }
}

TEST_CASE("a device that is gone is said to be gone in words of what was really tried") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (reads(frame, 0x2000)) self.dead = true;
    return self.dead;
  };
  can::SimulatedBus bus;
  const auto out = play(bus, device, two_reads, read_only(), slow_starter(3s));
  REQUIRE(out.run.aborted.has_value());
  CHECK_THAT(*out.run.aborted, Catch::Contains("no frame of it for 3 s"));
  CHECK(out.run.aborted->find("reset") == std::string::npos);
}

TEST_CASE("a device that does not come back by a reset gets its power switched, where that is possible") {
  ScriptedDevice device;
  device.entries[0x200000] = {7};
  device.on_reset = [](ScriptedDevice&) {};
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (!reads(frame, 0x2000)) return false;
    self.dead = true;
    return true;
  };
  can::SimulatedBus bus;
  RunOptions options;
  int switched = 0;
  options.power_cycle = [&]() -> Result<void> {
    ++switched;
    device.dead = false;
    device.send(boot_up);
    return {};
  };
  const auto out = play(bus, device, two_reads, options);
  CHECK(switched == 1);
  CHECK_FALSE(out.run.aborted.has_value());
  CHECK(out.verdict_of("T-OTHER") == Verdict::fail);
  CHECK(out.run.cases[1].verdict == Verdict::pass);
  CHECK(is_noted(out, "the power of the device was switched"));
  CHECK_FALSE(is_noted(out, "although nobody told it to"));
}

namespace {
const std::string switches_power = R"(
  - id: a
    title: t
    when: power switch is known
    risk: config
    steps:
      - power_cycle: once
        checks: T-MUST
        expect: ok
      - upload: {object: 1018h:01}
        checks: T-MUST
)";
}  // namespace

TEST_CASE("a scenario switches the power, and the start that follows is nobody's fault") {
  for (const bool starts : {true, false}) {
    ScriptedDevice device;
    can::SimulatedBus bus;
    RunOptions options;
    options.power_cycle = [&]() -> Result<void> {
      if (starts) device.send(boot_up);
      return {};
    };
    const auto out = play(bus, device, switches_power, options);
    CHECK_FALSE(out.run.aborted.has_value());
    CHECK(out.verdict_of("T-MUST") == (starts ? Verdict::pass : Verdict::fail));
    CHECK_FALSE(is_noted(out, "although nobody told it to"));
  }
}

TEST_CASE("without a power switch a scenario that needs one is not applicable, with the reason") {
  ScriptedDevice device;
  const auto out = play(device, switches_power);
  CHECK(out.run.cases[0].verdict == Verdict::not_applicable);
  CHECK_THAT(out.run.cases[0].reason, Catch::Contains("no way to switch the power of the device is known"));
}

TEST_CASE("a power switch that fails judges nothing, and says why") {
  ScriptedDevice device;
  can::SimulatedBus bus;
  RunOptions options;
  options.power_cycle = []() -> Result<void> { return fail("the command failed with exit code 1: relay"); };
  const auto out = play(bus, device, switches_power, options);
  CHECK(out.run.cases[0].verdict == Verdict::inconclusive);
  CHECK_THAT(out.run.cases[0].reason,
             Catch::Contains("the power of the device could not be switched: the command failed"));
  CHECK(out.run.counts().fail == 0);
  CHECK(result::exit_code(out.run) == 3);
}

TEST_CASE("two devices with one node-ID are recognised before anything is judged") {
  for (const bool same_kind : {false, true}) {
    ScriptedDevice device, twin;
    twin.entries[0x101801] = {2, 0, 0, 0};
    if (same_kind) twin.entries = device.entries;
    can::SimulatedBus bus;
    bus.attach(twin, "second device");
    const auto out = play(bus, device, two_reads);
    REQUIRE(out.run.aborted.has_value());
    CHECK_THAT(*out.run.aborted, Catch::Contains("two devices answer as node 1"));
    CHECK(out.run.counts().fail == 0);
    CHECK(result::exit_code(out.run) == 3);
  }
}

TEST_CASE("one device that answers twice is for the scenarios") {
  ScriptedDevice device;
  device.entries[0x101804] = {0x44, 0x33, 0x22, 0x11};
  device.entries[0x200000] = {7};
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    self.serve(frame);
    return false;
  };
  const auto out = play(device, two_reads);
  CHECK_FALSE(out.run.aborted.has_value());
}

TEST_CASE("a second device that joins during the run ends it") {
  ScriptedDevice device, twin;
  twin.entries[0x101801] = {2, 0, 0, 0};
  twin.dead = true;
  device.entries[0x200000] = twin.entries[0x200000] = {7};
  device.before = [&twin](ScriptedDevice&, const can::Frame& frame, BusTime) {
    if (reads(frame, 0x2000) && twin.dead) {
      twin.dead = false;
      twin.send(boot_up);
    }
    return false;
  };
  can::SimulatedBus bus;
  bus.attach(twin, "second device");
  const auto out = play(bus, device, two_reads);
  REQUIRE(out.run.aborted.has_value());
  CHECK_THAT(*out.run.aborted, Catch::Contains("two devices answer as node 1"));
  CHECK(out.run.counts().fail == 0);
}

TEST_CASE("a value that kills the device ends the walk at once and is named") {
  ScriptedDevice device;
  device.before = [dead = false](ScriptedDevice& self, const can::Frame& frame, BusTime) mutable {
    if (self.nmt.size() > 1) dead = false;
    dead = dead || (frame.data[0] == 0x2B && frame.data[4] == 3);
    if (dead && frame.data[0] == 0x2B && frame.data[4] == 3) self.serve(frame);
    return dead;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - over: {time: 1..100}
        steps:
          - download: {object: 1017h:00, value: $time}
            checks: T-MUST
            expect: abort 0609 0030h
      - upload: {object: 1000h:00}
        checks: T-OTHER
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  CHECK(out.verdict_of("T-OTHER") == Verdict::inconclusive);
  CHECK(out.run.elapsed < 60s);
  const auto& finding = out.only().judgements.front().findings.front();
  CHECK_THAT(finding.actual, Catch::Contains("3 of 3 values"));
  CHECK_THAT(finding.actual,
             Catch::Contains("behind 03h the device does not answer any more; 97 further values"));
}

TEST_CASE("an error of Stopped, where no EMCY tells of it, is ended so that the next one can be seen") {
  // However it was stopped.
  const std::string command = GENERATE("nmt: stop", "send: {id: 000h, data: \"02 00\"}");
  ScriptedDevice device;
  device.entries[0x200000] = {0};
  device.on_reset = [](ScriptedDevice& self) { self.entries[0x100100] = {0}; };
  bool was_stopped = false;
  device.before = [&was_stopped](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    // What befell it in Stopped, once.
    if (!was_stopped && std::ranges::find(self.nmt, 0x02) != self.nmt.end()) {
      was_stopped = true;
      self.entries[0x100100] = {1};
    }
    if (frame.data[0] == 0x2F && self.entries[0x100100].front() == 0)
      self.send(can::data_frame(CanId(0x81), {0x00, 0x10, 1, 0, 0, 0, 0, 0}));
    return false;
  };
  const auto out = play(device, R"(
  - id: stops
    title: t
    risk: motion
    steps:
      - )" + command + R"(
      - wait: 100 ms
      - nmt: pre-operational
      - upload: {object: 1000h:00}
        checks: T-OTHER
  - id: looks
    title: t
    risk: motion
    steps:
      - download: {object: 2000h:00, bytes: "01"}
      - frame: {id: emcy, within: 100 ms}
        checks: T-MUST
)");
  CHECK(out.verdict_of("T-MUST", 1) == Verdict::pass);
}

TEST_CASE("an error that does not clear is ended by a reset, so that the next one can be seen") {
  ScriptedDevice device;
  device.entries[0x200000] = {0};
  device.on_reset = [](ScriptedDevice& self) { self.entries[0x100100] = {0}; };
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    // A write of 1 to 2000h raises an error, once; 0 should clear it.
    if (frame.data[0] != 0x2F || frame.data[4] != 1 || self.entries[0x100100].front() != 0) return false;
    self.entries[0x100100] = {1};
    self.send(can::data_frame(CanId(0x81), {0x00, 0x10, 1, 0, 0, 0, 0, 0}));
    return false;
  };
  auto profile = device::default_profile(NodeId(1));
  device::TriggerWrite raise, clear;
  raise.object = clear.object = {Index(0x2000), SubIndex(0)};
  raise.bytes = {1};
  clear.bytes = {0};
  profile.errors.resize(1);
  profile.errors[0].code = 0x1000;
  profile.errors[0].raise = raise;
  profile.errors[0].clear = clear;
  profile.errors[0].heartbeat_node.reset();
  can::SimulatedBus bus;
  const auto out = play(bus, device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - raise_error: {trigger: 1}
      - emcy: {within: 1 s}
        checks: T-MUST
      - clear_error: 1
      - raise_error: {trigger: 1}
      - emcy: {within: 1 s}
        checks: T-OTHER
  - id: b
    title: t
    risk: config
    steps:
      - raise_error: {trigger: 1}
      - emcy: {within: 1 s}
        checks: T-MUST
)",
                        {}, profile);
  CHECK(out.verdict_of("T-MUST") == Verdict::pass);
  CHECK(out.verdict_of("T-OTHER") == Verdict::inconclusive);
  CHECK(out.verdict_of("T-MUST", 1) == Verdict::pass);
}
