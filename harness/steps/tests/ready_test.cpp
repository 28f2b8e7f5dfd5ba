// SPDX-License-Identifier: Apache-2.0
// Devices that are delivered with PDOs off, unmapped or fixed, as the producer of SYNC, or with one error
// control protocol only.
#include <chrono>

#include "catch.hpp"
#include "steps/tests/fake_session.hpp"
#include "steps/tests/parsed_steps.hpp"

namespace {

using namespace conform;
using namespace conform::steps;
using Kind = Actual::Kind;

constexpr Multiplexer at(std::uint16_t index, std::uint8_t sub) { return {Index(index), SubIndex(sub)}; }
constexpr Multiplexer tpdo_cob_id = at(0x1800, 1), tpdo_count = at(0x1A00, 0), tpdo_first = at(0x1A00, 1);

/// A TPDO with this COB-ID that maps nothing.
FakeSession with_tpdo(std::uint32_t cob_id) {
  FakeSession session;
  session.serves = true;
  session.entries[tpdo_cob_id] = to_le(cob_id, 4);
  session.entries[tpdo_count] = {0};
  return session;
}

device::Entry mappable(std::uint16_t index, device::Access access) {
  device::Entry out;
  out.mux = at(index, 1);
  out.type = canopen::DataType::unsigned16;
  out.access = access;
  out.pdo_mappable = out.safe = true;
  return out;
}

std::uint64_t number(FakeSession& session, Multiplexer object) { return load_le(session.entries[object]); }

Kind ran(const std::string& step, FakeSession& session) {
  const auto actual = parsed_step(step).action->run(session);
  REQUIRE(actual);
  return actual->kind;
}

TEST_CASE("A PDO that is valid and maps something stays as it is") {
  auto session = with_tpdo(0x185);
  session.entries[tpdo_count] = {1};
  CHECK(ran("- ready_pdo: 1800h\n", session) == Kind::confirmed);
  CHECK(session.written.empty());
}

TEST_CASE("A PDO that is off or maps nothing gets what the description offers, and its own CAN-ID") {
  auto off = with_tpdo(0xC000'0185);
  off.known.add(mappable(0x6000, device::Access::ro));
  CHECK(ran("- ready_pdo: 1800h\n", off) == Kind::confirmed);
  CHECK(number(off, tpdo_first) == 0x6000'0110);
  CHECK(number(off, tpdo_count) == 1);
  CHECK(number(off, tpdo_cob_id) == 0x4000'0185);
  // Without a description the error register; without a CAN-ID that of the connection set, or a free one.
  auto bare = with_tpdo(0x8000'0000);
  CHECK(ran("- ready_pdo: 1800h\n", bare) == Kind::confirmed);
  CHECK(number(bare, tpdo_first) == 0x1001'0008);
  CHECK(number(bare, tpdo_cob_id) == 0x185);
  FakeSession fifth;
  fifth.serves = true;
  fifth.entries[at(0x1804, 1)] = to_le(0x8000'0000, 4);
  fifth.entries[at(0x1A04, 0)] = {0};
  CHECK(ran("- ready_pdo: 1804h\n", fifth) == Kind::confirmed);
  CHECK(number(fifth, at(0x1804, 1)) == 0x6B4);
}

TEST_CASE("A PDO that cannot be made ready says what stood in the way") {
  auto fixed = with_tpdo(0x8000'0185);
  fixed.refused[tpdo_first] = AbortCode(0x0601'0002);
  CHECK(ran("- ready_pdo: 1800h\n", fixed) == Kind::aborted);
  CHECK(number(fixed, tpdo_cob_id) == 0x8000'0185);
  // Of what an RPDO writes, only what tests may write.
  FakeSession rpdo;
  rpdo.serves = true;
  rpdo.entries[at(0x1400, 1)] = to_le(0x8000'0205, 4);
  rpdo.entries[at(0x1600, 0)] = {0};
  auto output = mappable(0x6200, device::Access::rww);
  output.safe = false;
  rpdo.known.add(output);
  CHECK(ran("- ready_pdo: 1400h\n", rpdo) == Kind::silence);
  CHECK(rpdo.written.empty());
}

TEST_CASE("What produces SYNC is made a consumer, without a period in which it would miss any") {
  FakeSession session;
  session.serves = true;
  session.entries[at(0x1005, 0)] = to_le(0x4000'0080, 4);
  session.entries[at(0x1006, 0)] = to_le(100'000, 4);
  CHECK(ran("- ready_sync: consumer\n", session) == Kind::confirmed);
  CHECK(number(session, at(0x1005, 0)) == 0x80);
  CHECK(number(session, at(0x1006, 0)) == 0);
  session.written.clear();
  CHECK(ran("- ready_sync: consumer\n", session) == Kind::confirmed);
  CHECK(session.written.empty());
}

constexpr Multiplexer heartbeat_time = at(0x1017, 0);

device::Entry heartbeat_entry(device::Access access) {
  device::Entry out;
  out.mux = heartbeat_time;
  out.type = canopen::DataType::unsigned16;
  out.access = access;
  return out;
}

can::CapturedFrame shows(std::uint8_t byte, Duration time) {
  return {can::data_frame(CanId(0x705), {byte}), BusTime(time), can::Direction::received, {}};
}

/// What `step` measures of a device that shows its state when asked to every 100 ms.
Actual collected(FakeSession& session, const std::string& step) {
  const auto actual = parsed_step(step).action->run(session);
  REQUIRE(actual);
  return *actual;
}

TEST_CASE("A heartbeat that can be written shows the state as often as is wanted") {
  FakeSession session;
  session.serves = true;
  session.known.add(heartbeat_entry(device::Access::rw));
  CHECK(ran("- ready_error_control: 100 ms\n", session) == Kind::matched);
  CHECK(number(session, heartbeat_time) == 100);
  CHECK(session.produced.empty());
}

TEST_CASE("A heartbeat that comes more seldom shows the state as well, in as much more time") {
  using namespace std::chrono_literals;
  FakeSession session;
  session.serves = true;
  session.known.add(heartbeat_entry(device::Access::constant));
  session.entries[heartbeat_time] = to_le(350, 2);
  session.to_come = {shows(0x7F, 300ms)};
  REQUIRE(ran("- ready_error_control: 100 ms\n", session) == Kind::matched);
  CHECK(session.written.empty());
  CHECK(session.sent.empty());
  // 350 ms are up to four times 100 ms.
  for (const auto time : {650ms, 1000ms, 1370ms, 2100ms}) session.trace.add(shows(0x7F, time));
  const auto seen = collected(session, "- collect: {from: error control, for: 500 ms}\n");
  CHECK(seen.measured.at("count") == 4);
  CHECK(seen.measured.at("state") == 0x7F);
  CHECK(seen.measured.at("pace") == 102);
  CHECK(seen.measured.at("slowest") == 180);
  // Bit 7 is no toggle bit here.
  session.trace.add(shows(0xFF, 100ms));
  CHECK(collected(session, "- collect: {from: error control, for: 100 ms}\n").measured.at("state") == 0xFF);
}

TEST_CASE("A device without a heartbeat shows its state when it is guarded") {
  using namespace std::chrono_literals;
  FakeSession session;
  session.serves = session.remote = true;
  session.to_come = {shows(0x7F, 1ms)};
  REQUIRE(ran("- ready_error_control: 100 ms\n", session) == Kind::matched);
  REQUIRE(session.produced.size() == 1);
  CHECK(session.produced[0].frame.remote);
  CHECK(session.produced[0].every == 100ms);
  for (const auto byte : {0xFF, 0x7F}) session.trace.add(shows(static_cast<std::uint8_t>(byte), 200ms));
  const auto seen = collected(session, "- collect: {from: error control, for: 300 ms}\n");
  CHECK(seen.measured.at("state") == 0x7F);
}

TEST_CASE("Where nothing shows the state, it is said why") {
  using namespace std::chrono_literals;
  const auto why = [](FakeSession session) {
    session.serves = true;
    const auto actual = parsed_step("- ready_error_control: 100 ms\n").action->run(session);
    REQUIRE(actual);
    CHECK(actual->kind == Kind::silence);
    CHECK(session.produced.empty());
    return actual->detail;
  };
  FakeSession session;
  CHECK(why(session) == "there is no heartbeat, and the interface cannot send RTR");
  session.remote = true;
  CHECK(why(session) == "there is no heartbeat, and a guard request is not answered");
  // Whoever begins to guard may not leave off.
  session.entries[at(0x100C, 0)] = to_le(100, 2);
  session.entries[at(0x100D, 0)] = {3};
  CHECK(why(session) == "there is no heartbeat, and guard requests would start life guarding");
  CHECK(session.sent.empty());
  session.entries[heartbeat_time] = to_le(5000, 2);
  CHECK(why(session) == "a heartbeat comes every 5 s only");
  session.entries[heartbeat_time] = to_le(1000, 2);
  CHECK(why(session) == "no heartbeat within 2 s");
}

TEST_CASE("A COB-ID that is const and stays is no reason not to change what can be changed") {
  auto session = with_tpdo(0x185);
  session.entries[at(0x1800, 5)] = to_le(0, 2);
  session.refused[tpdo_cob_id] = AbortCode(0x0601'0002);
  CHECK(ran("- set_pdo: {pdo: 1800h, event_timer: 100}\n", session) == Kind::confirmed);
  CHECK(number(session, at(0x1800, 5)) == 100);
  CHECK(ran("- set_pdo: {pdo: 1800h, valid: false}\n", session) == Kind::aborted);
  CHECK(ran("- set_pdo: {pdo: 1800h, can_id: 6A0h}\n", session) == Kind::aborted);
  // Any other refusal ends it.
  session.refused[tpdo_cob_id] = AbortCode(0x0800'0022);
  CHECK(ran("- set_pdo: {pdo: 1800h, event_timer: 200}\n", session) == Kind::aborted);
}

TEST_CASE("A mapping that is const is taken where it is the one that is wanted") {
  auto session = with_tpdo(0x185);
  session.entries[tpdo_count] = {1};
  session.entries[tpdo_first] = to_le(0x6000'0108, 4);
  session.refused[tpdo_count] = AbortCode(0x0601'0002);
  CHECK(ran("- set_pdo: {pdo: 1800h, mapping: [6000 0108h]}\n", session) == Kind::confirmed);
  CHECK(ran("- set_pdo: {pdo: 1800h, mapping: [6000 0208h]}\n", session) == Kind::aborted);
  CHECK(ran("- set_pdo: {pdo: 1800h, mapping: [6000 0108h, 6000 0108h]}\n", session) == Kind::aborted);
}

TEST_CASE("Of what a PDO maps the first integer is found that tests may write") {
  FakeSession session;
  session.serves = true;
  session.entries[at(0x1600, 0)] = {2};
  session.entries[at(0x1600, 1)] = to_le(0x6200'0110, 4);
  session.entries[at(0x1600, 2)] = to_le(0x6201'0110, 4);
  session.entries[at(0x6200, 1)] = session.entries[at(0x6201, 1)] = {0, 0};
  auto first = mappable(0x6200, device::Access::rww);
  first.safe = false;
  session.known.add(first);
  session.known.add(mappable(0x6201, device::Access::rww));
  CHECK(ran("- mapped_entry: {pdo: 1400h, save: entry}\n", session) == Kind::confirmed);
  const auto* found = session.find("entry");
  REQUIRE(found != nullptr);
  CHECK(found->object == at(0x6201, 1));
  session.entries[at(0x1600, 0)] = {1};
  CHECK(ran("- mapped_entry: {pdo: 1400h, save: entry}\n", session) == Kind::silence);
}

TEST_CASE("A remote frame has the length that is asked for") {
  FakeSession session;
  const auto steps =
      parsed_steps("- let: {length: 3}\n- send: {id: 185h, rtr: true, dlc: $length}\n- let: {length: 16}\n");
  REQUIRE(steps.size() == 3);
  session.set("length", Value::of_number(3));
  CHECK(steps[1].action->run(session));
  REQUIRE(session.sent.size() == 1);
  CHECK(session.sent[0].remote);
  CHECK(session.sent[0].dlc == 3);
  session.set("length", Value::of_number(16));
  CHECK_FALSE(steps[1].action->run(session));
}

}  // namespace
