// SPDX-License-Identifier: Apache-2.0
// Random requests: the same in every run, and never a download that could reach an entry.
#include <algorithm>

#include "catch.hpp"
#include "steps/tests/fake_session.hpp"
#include "steps/tests/parsed_steps.hpp"

namespace {

using namespace conform;
using namespace conform::steps;

std::vector<can::Frame> sent_by(const std::string& text) {
  const auto step = parsed_step(text);
  CHECK(step.action->need().tier == Tier::config);
  FakeSession session;
  REQUIRE(step.action->run(session));
  return session.sent;
}

TEST_CASE("Noise is the same in every run, and another with another seed") {
  const auto once = sent_by("- noise: {frames: 50, every: 2 ms}\n");
  const auto again = sent_by("- noise: {frames: 50}\n");
  const auto other = sent_by("- noise: {frames: 50, seed: 2}\n");
  REQUIRE(once.size() == 50);
  CHECK(std::ranges::equal(
      once, again, {}, [](const auto& f) { return to_string(CanId(f.id)) + hex_bytes(f.bytes()); },
      [](const auto& f) { return to_string(CanId(f.id)) + hex_bytes(f.bytes()); }));
  CHECK(hex_bytes(once.back().bytes()) != hex_bytes(other.back().bytes()));
}

TEST_CASE("Noise never begins a download of an entry from 1000h on") {
  std::size_t downloads = 0, full = 0;
  for (const auto& frame : sent_by("- noise: {frames: 5000}\n")) {
    CHECK(frame.id == 0x605);
    if (frame.size() == 8) ++full;
    if (frame.size() == 0) continue;
    const unsigned command = frame.data[0] >> 5U;
    if (command != 1 && command != 6) continue;
    ++downloads;
    REQUIRE(frame.size() >= 4);
    CHECK((frame.data[1] | (frame.data[2] << 8U)) < 0x1000);
    CHECK((frame.data[2] | (frame.data[1] << 8U)) < 0x1000);
  }
  CHECK(downloads > 500);
  CHECK(full > 2500);
}

}  // namespace
