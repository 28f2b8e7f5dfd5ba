// SPDX-License-Identifier: Apache-2.0
#include "explore/shrink.hpp"

#include <algorithm>
#include <chrono>
#include "catch.hpp"

using namespace conform;
using namespace conform::explore;
using namespace std::chrono_literals;

namespace {

const Multiplexer heartbeat{Index(0x1017), SubIndex(0)};
const Multiplexer device_type{Index(0x1000), SubIndex(0)};

Conversation long_conversation() {
  Conversation out;
  for (int i = 0; i < 40; ++i) out.push_back(upload(device_type));
  out[7] = download(heartbeat, {0xE8, 0x03}, Transfer::segmented);
  out[22] = wait(640ms);
  return out;
}

}  // namespace

TEST_CASE("only the actions that are needed stay") {
  const auto shows = [](const Conversation& all) {
    const auto wrote = std::ranges::find_if(all, [](const Action& each) { return each.is_at(0x1017, 0); });
    return std::any_of(wrote, all.end(), [](const Action& each) { return each.kind == Action::Kind::wait; });
  };
  const auto shrunk = shrink(long_conversation(), shows);
  REQUIRE(shrunk.conversation.size() == 2);
  CHECK(shrunk.conversation[0].is_at(0x1017, 0));
  CHECK(shrunk.conversation[1].kind == Action::Kind::wait);
}

TEST_CASE("what stays is made plain: transfers, values and times") {
  const auto shows = [](const Conversation& all) {
    Duration waited{};
    bool wrote = false;
    for (const auto& each : all) {
      wrote = wrote || each.is_at(0x1017, 0);
      waited += each.time;
    }
    return wrote && waited >= 100ms;
  };
  const auto shrunk = shrink(long_conversation(), shows);
  REQUIRE(shrunk.conversation.size() == 2);
  CHECK(shrunk.conversation[0].transfer == Transfer::automatic);
  CHECK(shrunk.conversation[0].data == Bytes{0, 0});
  CHECK(shrunk.conversation[1].time == 160ms);
}

TEST_CASE("no more conversations are played than allowed") {
  std::size_t played = 0;
  const auto shrunk = shrink(long_conversation(), [&](const Conversation&) { return ++played > 0; }, 5);
  CHECK(played == 5);
  CHECK(shrunk.tries == 5);
}
