// SPDX-License-Identifier: Apache-2.0
// Which EMCY a step takes: any, that of a code, or that of an error whatever its code.
#include "catch.hpp"
#include "steps/tests/fake_session.hpp"
#include "steps/tests/parsed_steps.hpp"

namespace {

using namespace conform;
using namespace conform::steps;

/// What the step makes of the end of an error (0000h) that is followed by error 5000h.
std::string taken_by(const std::string& text) {
  const auto steps = parsed_steps(text);
  if (steps.size() != 1) return "error";
  FakeSession session;
  session.trace.add(
      {can::data_frame(CanId(0x85), {0, 0, 0, 0, 0, 0, 0, 0}), {}, can::Direction::received, ""});
  session.trace.add(
      {can::data_frame(CanId(0x85), {0x00, 0x50, 1, 0, 0, 0, 0, 0}), {}, can::Direction::received, ""});
  const auto actual = steps[0].action->run(session);
  REQUIRE(actual);
  return actual->decisive ? hex_bytes(std::span(actual->data).first(2)) : "nothing";
}

TEST_CASE("Without a code the first EMCY is taken, the end of an error too") {
  CHECK(taken_by("- emcy: {within: 1 s}\n") == "00 00");
  CHECK(taken_by("- emcy: {code: 0, within: 1 s}\n") == "00 00");
}

TEST_CASE("Where an error is waited for, the end of another one is none") {
  CHECK(taken_by("- emcy: {code: error, within: 1 s}\n") == "00 50");
  CHECK(taken_by("- emcy: {code: 5000h, within: 1 s}\n") == "00 50");
  CHECK(taken_by("- emcy: {code: errors, within: 1 s}\n") == "error");
}

TEST_CASE("An EMCY that the inhibit time holds back is waited for") {
  const auto says = [](std::string_view text, Duration held) {
    FakeSession session;
    session.emcy_held += held;
    session.trace.add({can::data_frame(CanId(0x85), {0x30, 0x81, 0x11, 0, 0, 0, 0, 0}),
                       BusTime() + std::chrono::milliseconds(1015), can::Direction::received, ""});
    const auto actual = parsed_steps(std::string(text)).at(0).action->run(session);
    REQUIRE(actual);
    return actual->decisive.has_value();
  };
  using std::chrono::milliseconds;
  for (const auto* text :
       {"- emcy: {within: 800 ms}\n", "- frame: {id: emcy error, within: 475 ms..800 ms}\n"}) {
    INFO(text);
    CHECK_FALSE(says(text, {}));
    CHECK_FALSE(says(text, milliseconds(900)));
    CHECK(says(text, milliseconds(1020)));
  }
  CHECK_FALSE(says("- frame: {id: 281h, within: 800 ms}\n", milliseconds(1020)));
}

}  // namespace
