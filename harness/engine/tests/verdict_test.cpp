// SPDX-License-Identifier: Apache-2.0
// How what came becomes a verdict, seen through whole runs on the simulated bus.
#include "bench.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using result::Verdict;

TEST_CASE("an expected answer passes and says nothing more") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
        expect: {size: 4, value: 0000 0191h}
)");
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(out.only().judgements.front().findings.empty());
  CHECK(out.only().finished);
  CHECK(result::exit_code(out.run) == 0);
}

TEST_CASE("an unlisted outcome fails a mandatory rule and only warns for a recommended one, unless strict") {
  const std::string scenarios = R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1000h:00}
        checks: [T-MUST, T-SHOULD]
        expect: abort 0602 0000h
)";
  ScriptedDevice device;
  const auto out = play(device, scenarios);
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  CHECK(out.verdict_of("T-SHOULD") == Verdict::warn);
  CHECK(result::exit_code(out.run) == 1);
  RunOptions strict;
  strict.strict = true;
  ScriptedDevice again;
  CHECK(play(again, scenarios, strict).verdict_of("T-SHOULD") == Verdict::fail);
}

TEST_CASE("a tolerated abort code warns and does not touch the rule about the value") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] != 0x2B) return false;
    self.abort(frame, 0x08000000);
    return true;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
        checks: T-MUST
        expect: abort 0609 0030h
        warn: [abort 0800 0000h]
      - upload: {object: 1017h:00}
        checks: T-OTHER
        expect: unchanged
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::warn);
  CHECK(out.verdict_of("T-OTHER") == Verdict::pass);
  CHECK(out.only().verdict == Verdict::warn);
  CHECK(result::exit_code(out.run) == 0);
}

TEST_CASE("a failed set-up step makes what follows inconclusive, never failed") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 2345h:00, save: x}
      - upload: {object: 1000h:00}
        checks: T-MUST
        expect: {value: $x}
)");
  CHECK(out.only().verdict == Verdict::inconclusive);
  CHECK(out.verdict_of("T-MUST") == Verdict::inconclusive);
  CHECK(out.only().setup_findings.size() == 1);
  CHECK(result::exit_code(out.run) == 3);
}

TEST_CASE("silence of a device that is alive is a failure") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice&, const can::Frame& frame, BusTime) { return frame.data[0] == 0x2B; };
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
        checks: T-MUST
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  CHECK(out.only().judgements.front().findings.front().actual == "no answer within 3 s");
}

TEST_CASE(
    "a condition that does not hold makes the case not applicable, and the reason is the part that was false") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    when: object 1010h is present
    steps:
      - upload: {object: 1010h:01}
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::not_applicable);
  CHECK(out.only().reason == "1010h is absent: abort 0602 0000h (object does not exist)");
  CHECK(result::exit_code(out.run) == 2);
}

TEST_CASE("values walked over in one step are told in one finding that names the offenders") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - over: {time: [1, 2, 500..502]}
        steps:
          - download: {object: 1017h:00, value: $time}
            checks: T-MUST
            expect: abort any
)");
  const auto& findings = out.only().judgements.front().findings;
  REQUIRE(findings.size() == 1);
  CHECK(
      findings.front().actual.starts_with("5 of 5 values: 01h: confirmed; 02h: confirmed; 1F4h: confirmed"));
  CHECK(out.only().judgements.front().expectations == 5);
}

TEST_CASE("alternatives continue differently, and taking a tolerated one warns") {
  const std::string scenarios = R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
        checks: T-MUST
        either:
          - if: abort any
          - if: ok
            verdict: warn
            steps:
              - upload: {object: 1017h:00}
                checks: T-OTHER
                expect: {value: 1000}
)";
  ScriptedDevice device;
  const auto out = play(device, scenarios);
  CHECK(out.verdict_of("T-MUST") == Verdict::warn);
  CHECK(out.verdict_of("T-OTHER") == Verdict::pass);
}

TEST_CASE("a requirement is judged under its own id also when a scenario names its alias") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1000h:00}
        checks: T-ALIAS
)");
  CHECK(out.verdict_of("T-OTHER") == Verdict::pass);
}

TEST_CASE("an answer about another object is a protocol violation, not data") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[1] != 0x17) return false;
    auto answer = frame;
    answer.id = 0x581;
    answer.data = {0x4B, 0x18, 0x10, 0x00, 1, 0, 0, 0};
    self.send(answer);
    return true;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1017h:00}
        checks: T-MUST
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  CHECK(out.only().judgements.front().findings.front().actual.starts_with("protocol violation"));
}

TEST_CASE("a conversation shows the first wrong byte") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - talk: |
          > 600+N: 40 00 10 00 00 00 00 00
          < 580+N: 43 00 10 00 91 02 00 00
        checks: T-MUST
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  CHECK(out.only().judgements.front().findings.front().actual.find("91 [01] 00 00") != std::string::npos);
}

TEST_CASE("an answer that is none of the ways left open is shown") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - talk: |
          > 600+N: 40 00 10 00 00 00 00 00
        either:
          - talk: |
              silence 580+N for 50 ms
            checks: T-MUST
          - talk: |
              < 580+N: 80 ..
            checks: T-MUST
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  const auto& finding = out.only().judgements.front().findings.front();
  CHECK(finding.actual == "581h: 43 00 10 00 91 01 00 00 came, none of the ways listed");
  const auto shown = std::ranges::find_if(finding.evidence, &result::EvidenceFrame::decisive);
  REQUIRE(shown != finding.evidence.end());
  CHECK(shown->frame.id == 0x581);
}

TEST_CASE("the next conversation line sees frames that came before it was reached") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    self.send(can::data_frame(CanId(0x081), {0x30, 0x81, 0x11, 0, 0, 0, 0, 0}));
    self.serve(frame);
    return true;
  };
  // The EMCY comes before the SDO answer that the step in front of it waits for.
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
      - emcy: {code: 8130h, within: 100 ms, save_register: register}
        checks: T-MUST
        expect: {register: 17}
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::pass);
}

// Seen on a real socket: a TPDO that left the device between two requests of the step before was called "too
// early".
TEST_CASE("a frame that comes while the step before is still asking is in time") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] == 0x23 && self.writes.empty()) self.send(can::data_frame(CanId(0x6A0), {1}));
    return false;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - set_cob_id: {object: 1014h:00, to: 6B0h}
      - frame: {id: 6A0h, within: 1 s}
        checks: T-MUST
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::pass);
}

TEST_CASE("a frame that does not come is told with what went before it, and how long it was waited for") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1000h:00}
      - let: {id: 1A5h}
      - frame: {id: $id, within: 40 ms}
        checks: T-MUST
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  const auto& finding = out.only().judgements.front().findings.front();
  CHECK(finding.accepts == std::vector<std::string>{"a frame"});
  CHECK(finding.prepared == std::vector<std::string>{"upload 1000h:00"});
  REQUIRE(finding.listened);
  CHECK(finding.listened->until - finding.listened->from >= std::chrono::milliseconds(40));
  REQUIRE(finding.evidence.size() >= 2);
  CHECK(finding.evidence.front().frame.id == 0x601);
}

TEST_CASE("a request without an answer is told with the time that nothing followed it") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice&, const can::Frame& frame, BusTime) {
    return frame.data[0] == 0x40 && frame.data[1] == 0x17;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1017h:00}
        checks: T-MUST
)");
  const auto& finding = out.only().judgements.front().findings.front();
  INFO(finding.step + " -> " + finding.actual);
  REQUIRE(finding.listened);
  REQUIRE_FALSE(finding.evidence.empty());
  CHECK(std::ranges::any_of(finding.evidence, [&](const auto& frame) {
    return frame.time == finding.listened->from && frame.direction == can::Direction::transmitted;
  }));
}

TEST_CASE("a condition that fails is told with its values, and once") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - let: {one: 5, other: 7}
      - require: $one is $other
        checks: T-MUST
)");
  const auto& finding = out.only().judgements.front().findings.front();
  CHECK(finding.actual == "does not hold: one is 5, not 7");
  CHECK(finding.accepts == std::vector<std::string>{"$one is $other"});
}

TEST_CASE("of several measurements the ones that miss are named") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - collect: {from: 1A5h, for: 100 ms}
        checks: T-MUST
        expect: {count: 2..}
)");
  const auto& finding = out.only().judgements.front().findings.front();
  CHECK(finding.reason == "count 0 instead of at least 2");
  CHECK(finding.accepts == std::vector<std::string>{"count at least 2"});
}
