// SPDX-License-Identifier: Apache-2.0
// What would make a verdict untrustworthy: dirty channels, blame for what was not reached.
#include "bench.hpp"
#include "engine/monitor_cases.hpp"

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

}  // namespace

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

TEST_CASE(
    "a profile that promises a quick device makes no monitor stricter, one of a slow device more patient") {
  auto profile = writing_profile();
  profile.nmt_time = 30ms;
  CHECK(facts_of(profile).nmt_time == 100ms);
  // But it hears what the run tells it behind its boot-up.
  CHECK(facts_of(profile).deaf_time == 30ms);
  profile.nmt_time = 2s;
  CHECK(facts_of_run(profile).nmt_time == 2s);
}
