// SPDX-License-Identifier: Apache-2.0
// How a guard request is written, and how long a reply may take.
#include <chrono>

#include "catch.hpp"
#include "steps/tests/fake_session.hpp"
#include "steps/tests/parsed_steps.hpp"

namespace {

using namespace conform;
using namespace conform::steps;

std::string words_of(const std::string& text) {
  const auto steps = parsed_steps(text);
  return steps.size() != 1 ? "error" : std::string(word_of(steps[0].action->need().tier));
}

TEST_CASE("Guard requests are remote frames, which a configuration may send") {
  CHECK(words_of("- guard: once\n") == "config");
  CHECK(words_of("- guard: {count: 10, every: 100 ms, dlc: 0, save: last}\n") == "config");
  CHECK(words_of("- produce: {guard: {every: 10 ms}}\n") == "config");
  CHECK(words_of("- stop: guard\n") != "error");
}

TEST_CASE("Several guard requests need the time between two") {
  CHECK(words_of("- guard: twice\n") == "error");
  CHECK(words_of("- guard: {count: 10}\n") == "error");
  CHECK(words_of("- guard: {count: 0, every: 1 s}\n") == "error");
  CHECK(words_of("- guard: {count: 2, every: 1 s, dlc: 9}\n") == "error");
  CHECK(words_of("- produce: {guard: {}}\n") == "error");
}

TEST_CASE("A reply that a busy computer holds back for longer than T_NMT is a reply") {
  using namespace std::chrono_literals;
  FakeSession session;
  session.device_profile.nmt_time = 10ms;
  session.to_come = {{can::data_frame(CanId(0x705), {0x7F}), BusTime(60ms), can::Direction::received, {}}};
  const auto actual = parsed_step("- guard: once\n").action->run(session);
  REQUIRE(actual);
  CHECK(actual->measured.at("replies") == 1);
}

}  // namespace
