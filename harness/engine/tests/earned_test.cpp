// SPDX-License-Identifier: Apache-2.0
// A pass is earned: by a step that decides the requirement, was carried out, and met its expectation.
#include "bench.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using result::Verdict;

namespace {

const result::Judgement& judgement_of(const Outcome& out, const std::string& requirement) {
  for (const auto& judgement : out.only().judgements) {
    if (judgement.requirement == requirement) return judgement;
  }
  FAIL("no judgement of " << requirement);
  return out.only().judgements.front();
}

/// Aborts every download.
void refuse_writes(ScriptedDevice& device) {
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if ((frame.data[0] & 0xE0U) != 0x20) return false;
    self.abort(frame, 0x06010002);
    return true;
  };
}

}  // namespace

// A device that only sends TPDOs on events passed rules about synchronous ones: what stood in front of "not
// applicable" had passed.
TEST_CASE("a way that does not concern the device withdraws what passed on it before") {
  ScriptedDevice device;
  refuse_writes(device);
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
        expect: ok
      - download: {object: 1017h:00, value: 1000}
        checks: T-MUST
        either:
          - if: ok
          - if: abort any
            verdict: not applicable
)");
  CHECK(out.only().verdict == Verdict::not_applicable);
  CHECK(judgement_of(out, "T-MUST").verdict == Verdict::not_applicable);
  CHECK_FALSE(judgement_of(out, "T-MUST").decided_by);
  CHECK(out.only().reason.starts_with(
      "does not concern this device: download 1017h:00 = 03E8h gave abort 0601 0002h"));
}

TEST_CASE("what a later step would still have decided has not passed either, and what is decided stays") {
  ScriptedDevice device;
  refuse_writes(device);
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - upload: {object: 1000h:00}
        checks: [T-MUST, T-OTHER]
        expect: ok
      - download: {object: 1017h:00, value: 1000}
        either:
          - if: ok
          - if: abort any
            verdict: not applicable
      - upload: {object: 1017h:00}
        checks: T-MUST
        expect: {value: 1000}
)");
  CHECK(judgement_of(out, "T-MUST").verdict == Verdict::not_applicable);
  CHECK(judgement_of(out, "T-OTHER").verdict == Verdict::pass);
  CHECK(out.only().verdict == Verdict::pass);
}

TEST_CASE("what failed before a way that does not concern the device stays failed") {
  ScriptedDevice device;
  refuse_writes(device);
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
        expect: {value: 1}
      - download: {object: 1017h:00, value: 1000}
        checks: T-MUST
        either:
          - if: ok
          - if: abort any
            verdict: not applicable
)");
  CHECK(out.only().verdict == Verdict::fail);
}

TEST_CASE("inside an over only the value ends that does not concern the device") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] != 0x2B || frame.data[4] != 2) return false;
    self.abort(frame, 0x06090030);
    return true;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - over: {time: [1, 2, 3]}
        steps:
          - download: {object: 1017h:00, value: $time}
            checks: T-MUST
            either:
              - if: ok
              - if: abort 0609 0030h
                verdict: not applicable
          - upload: {object: 1017h:00}
            checks: T-MUST
            expect: {value: $time}
)");
  CHECK(judgement_of(out, "T-MUST").verdict == Verdict::pass);
  CHECK(std::ranges::count(device.writes, "1017h = 03 00") == 1);
}

TEST_CASE("where no value of an over concerns the device, nothing passes") {
  ScriptedDevice device;
  refuse_writes(device);
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - over: {time: [1, 2]}
        steps:
          - upload: {object: 1000h:00}
            checks: T-MUST
            expect: ok
          - download: {object: 1017h:00, value: $time}
            checks: T-MUST
            either:
              - if: ok
              - if: abort any
                verdict: not applicable
)");
  CHECK(out.only().verdict == Verdict::not_applicable);
}

TEST_CASE("a pass names the step that decided it, and the frame") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1001h:00}
      - upload: {object: 1000h:00}
        checks: T-MUST
        expect: {size: 4}
)");
  const auto& decided = judgement_of(out, "T-MUST").decided_by;
  REQUIRE(decided);
  CHECK(decided->position.file == "test.yaml");
  CHECK(decided->position.line == 9);
  CHECK(decided->step == "upload 1000h:00");
  REQUIRE(decided->frame);
  CHECK(out.capture.frames()[*decided->frame].frame.id == 0x581);
}

TEST_CASE("strict lifts every tolerance of a rule that only recommends, and none of one that binds") {
  const std::string scenarios = R"(
  - id: a
    title: t
    steps:
      - upload: {object: 2345h:00}
        checks: [T-MUST, T-SHOULD]
        expect: ok
        warn: abort any
  - id: b
    title: t
    steps:
      - upload: {object: 2345h:00}
        checks: [T-MUST, T-SHOULD]
        either:
          - if: ok
          - if: abort any
            verdict: warn
)";
  for (const bool strict : {false, true}) {
    ScriptedDevice device;
    RunOptions options;
    options.strict = strict;
    const auto out = play(device, scenarios, options);
    for (const std::size_t index : {0U, 1U}) {
      CHECK(out.verdict_of("T-MUST", index) == Verdict::warn);
      CHECK(out.verdict_of("T-SHOULD", index) == (strict ? Verdict::fail : Verdict::warn));
    }
  }
}
