// SPDX-License-Identifier: Apache-2.0
#include "explore/guide.hpp"

#include <algorithm>
#include "catch.hpp"

#include "explore/coverage.hpp"
#include "explore/tests/device.hpp"

using namespace conform;
using namespace conform::explore;

namespace {

const NodeId node(5);
const Answer confirmed{.kind = Answer::Kind::confirmed}, nothing{};

}  // namespace

TEST_CASE("a state is where the device is and what was said last, whatever the values are") {
  const auto heartbeat = [](std::uint8_t time) { return download({Index(0x1017), SubIndex(0)}, {time, 0}); };
  const Conversation talk{heartbeat(100), heartbeat(50), heartbeat(0), nmt(node, 1), nmt(node, 0x82)};
  const auto states =
      states_of(talk, std::vector<Answer>{confirmed, confirmed, confirmed, nothing, nothing}, node);
  REQUIRE(states.size() == 5);
  CHECK(states[0] == states[1]);
  CHECK(states[1] != states[2]);
  CHECK(states[3] != states[4]);
  // A refused download has switched nothing.
  const Answer refused{.kind = Answer::Kind::aborted, .code = AbortCode(0x06010002)};
  CHECK(states_of(talk, std::vector<Answer>{refused}, node).front() != states[0]);
  CHECK(states_of(talk, {}, node).empty());
}

TEST_CASE("a conversation is kept up to where it came to something new") {
  Guide guide;
  const Conversation talk{nmt(node, 1), nmt(node, 2), nmt(node, 0x80)};
  CHECK(guide.note(talk, std::vector<std::uint64_t>{1, 2, 1}));
  CHECK_FALSE(guide.note(talk, std::vector<std::uint64_t>{2, 1, 2}));
  REQUIRE(guide.kept().size() == 1);
  CHECK(guide.kept().front() == Conversation{nmt(node, 1), nmt(node, 2)});
  CHECK(guide.states() == 2);
  Random random(1);
  const Conversation fresh(40, wait(std::chrono::milliseconds(7)));
  for (int i = 0; i < 100; ++i) {
    const auto out = guide.like_kept(random, fresh, 30);
    CHECK(out.size() <= 30);
    CHECK(!out.empty());
  }
}

TEST_CASE("a search begins with the conversations of earlier ones, and tells the new ones") {
  SearchOptions options;
  options.most_actions = 400;
  options.guided = 50;
  const auto words = words_of_the_standard();
  const auto first = search(bench_of({}), words, options);
  REQUIRE(first);
  CHECK(first->findings.empty());
  CHECK(first->states > 20);
  REQUIRE(!first->kept.empty());
  // Where a defect shows in a kept conversation, it is found at once.
  options.corpus = {
      {nmt(node, 2), wait(std::chrono::milliseconds(200)), upload({Index(0x1000), SubIndex(0)})}};
  const auto second = search(bench_of({"sdo-served-in-stopped"}), words, options);
  REQUIRE(second);
  REQUIRE(!second->findings.empty());
  CHECK(second->findings.front().actions_until <= 3);
}
