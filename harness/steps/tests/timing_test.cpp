// SPDX-License-Identifier: Apache-2.0
// What a row of time stamps says, and the verb that counts and times frames.
#include "steps/timing.hpp"

#include "catch.hpp"
#include "steps/tests/fake_session.hpp"
#include "steps/tests/parsed_steps.hpp"

namespace {

using namespace conform;
using namespace conform::steps;
using namespace std::chrono_literals;

std::vector<BusTime> at(std::initializer_list<int> milliseconds) {
  std::vector<BusTime> out;
  for (const int each : milliseconds) out.emplace_back(std::chrono::milliseconds(each));
  return out;
}

Actual collected(FakeSession& session, const std::string& text) {
  const auto step = parsed_step(text);
  const auto actual = step.action->run(session);
  REQUIRE(actual);
  return *actual;
}

void record(FakeSession& session, int milliseconds, std::uint32_t id, bool sent = false) {
  session.trace.add(can::CapturedFrame{can::data_frame(CanId(id), Bytes{0x7F}),
                                       BusTime(std::chrono::milliseconds(milliseconds)),
                                       sent ? can::Direction::transmitted : can::Direction::received,
                                       {}});
}

}  // namespace

// A heartbeat that dies six seconds after it was switched on had kept its period as long as it lived.
TEST_CASE("a producer that falls silent has its longest distance at the end of the window") {
  const auto distances = distances_of(at({100, 200, 300}), BusTime(1s));
  CHECK(distances.mean == 100ms);
  CHECK(distances.shortest == 100ms);
  CHECK(distances.longest == 700ms);
}

TEST_CASE("a single frame has a distance to the end of the window, and no other") {
  const auto distances = distances_of(at({100}), BusTime(250ms));
  CHECK(distances.longest == 150ms);
}

TEST_CASE("answers belong to the stimulus before them, however late that was sent") {
  // The third SYNC was 40 ms late: the distance of the TPDOs says nothing about the device.
  const auto answers = answers_of(at({0, 50, 140, 150}), at({2, 53, 141, 152}));
  CHECK(answers.missed == 0);
  CHECK(answers.extra == 0);
  CHECK(answers.shortest == 1);
  CHECK(answers.longest == 1);
  CHECK(answers.latencies == std::vector<Duration>{1ms, 2ms, 2ms, 3ms});
}

TEST_CASE("answers that are missing are counted, those before the first by themselves") {
  const auto answers = answers_of(at({0, 50, 100, 150, 200}), at({51, 201}));
  CHECK(answers.missed == 3);
  CHECK(answers.skipped == 1);
  CHECK(answers.shortest == 3);
  CHECK(answers.longest == 3);
}

TEST_CASE("what comes twice, or before anything was sent, is extra") {
  const auto answers = answers_of(at({10, 60}), at({5, 11, 12, 61}));
  CHECK(answers.extra == 2);
  CHECK(answers.missed == 0);
}

TEST_CASE("answers that end early make the distance longer, and none at all the longest") {
  CHECK(answers_of(at({0, 50, 100, 150}), at({1, 51})).longest == 3);
  const auto none = answers_of(at({0, 50, 100}), {});
  CHECK(none.missed == 3);
  CHECK(none.skipped == 3);
  CHECK(none.longest == 4);
  CHECK(none.latencies.empty());
}

TEST_CASE("every second SYNC is a distance of two, wherever the device begins to count") {
  const auto first = answers_of(at({0, 50, 100, 150}), at({1, 101}));
  const auto second = answers_of(at({0, 50, 100, 150}), at({51, 151}));
  CHECK(first.longest == 2);
  CHECK(first.shortest == 2);
  CHECK(second.longest == 2);
  CHECK(second.shortest == 2);
}

TEST_CASE("a collection per SYNC goes on behind the last SYNC and measures the answers") {
  FakeSession session;
  session.set("sync_can_id", Value::of_number(0x88));
  record(session, 0, 0x88, true);
  record(session, 3, 0x185);
  record(session, 40, 0x88, true);
  record(session, 41, 0x185);
  record(session, 80, 0x88, true);
  record(session, 131, 0x185);  // 51 ms after the last SYNC
  const auto actual = collected(session, "- collect: {from: 185h, per: sync, for: 50 ms}\n");
  CHECK(actual.measured.at("count") == 2);
  CHECK(actual.measured.at("missed") == 1);
  CHECK(actual.measured.at("farthest") == 2);
  CHECK(actual.measured.at("latency") == 3'000'000);
}

TEST_CASE("a step is told with the CAN-ID that its name stands for") {
  FakeSession session;
  const auto words = [&session](const std::string& action) {
    const auto steps = parsed_steps("- let: {id: 281h}\n" + action);
    REQUIRE(steps.size() == 2);
    return steps[1].action->words(session);
  };
  const std::string wait = "- frame: {id: $id, within: 200 ms}\n";
  CHECK(words(wait) == "a frame of CAN-ID $id within 200 ms");
  session.set("id", Value::of_number(0x281));
  CHECK(words(wait) == "a frame of CAN-ID 281h within 200 ms");
  CHECK(words("- silence: {of: [$id, emcy], for: 1 s}\n") == "silence of CAN-ID 281h, emcy for 1 s");
  CHECK(words("- collect: {from: $id, per: $id, for: 1 s}\n")
            .starts_with("collect CAN-ID 281h per frame on CAN-ID 281h"));
}

TEST_CASE("a SYNC that the device sends itself is one to be answered, and does not prolong the collection") {
  FakeSession session;
  session.set("sync_can_id", Value::of_number(0x88));
  record(session, 0, 0x88);
  record(session, 1, 0x185);
  record(session, 40, 0x88);
  record(session, 41, 0x185);
  record(session, 80, 0x88);
  const auto actual = collected(session, "- collect: {from: 185h, per: sync, for: 60 ms}\n");
  CHECK(actual.measured.at("count") == 2);
  CHECK(actual.measured.at("missed") == 0);
  CHECK(actual.measured.at("length") == 1);
}

TEST_CASE("counters and times of day are read from the frames that are collected") {
  const auto add = [](FakeSession& session, int milliseconds, Bytes data) {
    session.trace.add(can::CapturedFrame{can::data_frame(CanId(0x88), data),
                                         BusTime(std::chrono::milliseconds(milliseconds)),
                                         can::Direction::received,
                                         {}});
  };
  FakeSession counting;
  add(counting, 10, {2});
  add(counting, 20, {3});
  add(counting, 30, {1});
  add(counting, 40, {3});
  const auto counted = collected(counting, "- collect: {from: 88h, for: 1 s, counter: 3}\n");
  CHECK(counted.measured.at("start") == 2);
  CHECK(counted.measured.at("out_of_order") == 1);
  CHECK_FALSE(counted.measured.contains("malformed"));

  FakeSession telling;
  add(telling, 0, {0, 0, 0, 0, 1, 0});
  add(telling, 1000, {0, 0, 0, 0, 1, 0});
  const auto told = collected(telling, "- collect: {from: 88h, for: 2 s, time_of_day: true}\n");
  CHECK(told.measured.at("malformed") == 0);
  CHECK(told.measured.at("drift") == 1'000'000'000);
}

TEST_CASE("a collection ends with the frame that is enough, and with its time where fewer come") {
  const std::string step = "- collect: {from: 185h, for: 500 ms, enough: 3}\n";
  FakeSession quick;
  for (const auto time : {10, 20, 30, 40}) record(quick, time, 0x185);
  const auto three = collected(quick, step);
  CHECK(three.measured.at("count") == 3);
  CHECK(three.measured.at("period") == 10'000'000);
  // The time behind the last frame is no distance: nothing was waited for any more.
  CHECK(three.measured.at("longest") == 10'000'000);

  FakeSession slow;
  for (const auto time : {10, 400}) record(slow, time, 0x185);
  const auto two = collected(slow, step);
  CHECK(two.measured.at("count") == 2);
  CHECK(two.measured.at("longest") == 390'000'000);
}

TEST_CASE("a collection for answers needs something that was sent") {
  FakeSession session;
  record(session, 3, 0x185);
  const auto step = parsed_step("- collect: {from: 185h, per: sync, for: 50 ms}\n");
  const auto actual = step.action->run(session);
  REQUIRE_FALSE(actual);
  CHECK(actual.error().of == Error::Of::scenario);
}
