// SPDX-License-Identifier: Apache-2.0
// Where SYNC is sent.
#include "catch.hpp"
#include "steps/tests/fake_session.hpp"
#include "steps/tests/parsed_steps.hpp"

namespace {

using namespace conform;
using namespace conform::steps;

constexpr Multiplexer cob_id_sync{Index(0x1005), SubIndex(0)};

TEST_CASE("SYNC goes to the CAN-ID of 1005h, and to 080h where there is none") {
  FakeSession session;
  const auto step = parsed_step("- send_sync: once\n");
  REQUIRE(step.action->run(session));
  session.entries[cob_id_sync] = {0x81, 0x00, 0x00, 0x80};
  REQUIRE(step.action->run(session));
  session.entries[cob_id_sync] = {0x81, 0x00, 0x00, 0x20};
  REQUIRE(step.action->run(session));
  REQUIRE(session.sent.size() == 3);
  CHECK(session.sent[0].id == 0x80);
  CHECK(session.sent[1].id == 0x81);
  CHECK_FALSE(session.sent[1].extended);
  CHECK(session.sent[2].id == 0x81);
  CHECK(session.sent[2].extended);
}

TEST_CASE("SYNC is not sent where it would be a frame of another service") {
  FakeSession session;
  session.entries[cob_id_sync] = {0x00, 0x00, 0x00, 0x00};
  const auto sent = parsed_step("- send_sync: once\n").action->run(session);
  REQUIRE_FALSE(sent);
  CHECK(sent.error().what == "1005h:00 is 00000000h, and no SYNC can be sent on the restricted CAN-ID 000h");
  CHECK(session.sent.empty());
}

TEST_CASE("A CAN-ID that comes from the device does not make a frame an NMT command") {
  FakeSession session;
  session.set("sync", Value::of_number(0));
  auto steps =
      parsed_steps("- let: {sync: 0}\n- send: {id: $sync, data: \"01\"}\n- send: {id: 000h, data: \"01\"}\n");
  REQUIRE(steps.size() == 3);
  const auto sent = steps[1].action->run(session);
  REQUIRE_FALSE(sent);
  CHECK(sent.error().what == "'$sync' is 000h, the CAN-ID of NMT");
  CHECK(steps[2].action->run(session));
  CHECK(session.sent.size() == 1);
}

}  // namespace
