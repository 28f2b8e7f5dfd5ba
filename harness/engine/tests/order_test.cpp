// SPDX-License-Identifier: Apache-2.0
// What a case leaves behind must not show in the next one, whatever their order is.
#include "bench.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/sdo_initiate.hpp"
#include "engine/others.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using namespace std::chrono_literals;
using result::Verdict;

namespace {

const can::Frame moved_emcy = can::data_frame(CanId(0x6A0), {0x00, 0x10, 1, 0, 0, 0, 0, 0});
const can::Frame some_emcy = can::data_frame(CanId(0x81), {0x00, 0x10, 1, 0, 0, 0, 0, 0});

/// Whoever writes 1 to 2000h gets an EMCY.
void give_errors(ScriptedDevice& device, const can::Frame& emcy = some_emcy) {
  device.entries[0x200000] = {0};
  device.entries[0x101500] = {0, 0};
  device.before = [emcy](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] == 0x2F && frame.data[2] == 0x20 && frame.data[4] == 1) self.send(emcy);
    return false;
  };
}

/// From the last EMCY of the first of two cases to the beginning of the second.
Duration between(const Outcome& out, const can::Frame& emcy) {
  std::optional<BusTime> sent;
  for (const auto& captured : out.capture.frames()) {
    if (captured.frame.id == emcy.id) sent = captured.time;
  }
  REQUIRE(sent.has_value());
  REQUIRE(out.run.cases.size() == 2);
  return out.run.cases[1].begin - *sent;
}

/// A case of these steps, and another one behind it.
Outcome play_before_another(ScriptedDevice& device, const std::string& steps) {
  const std::string head = "\n    title: t\n    risk: config\n    steps:\n";
  return play(device, "\n  - id: first" + head + steps + "\n  - id: next" + head + R"(
      - upload: {object: 1000h:00}
        checks: T-MUST
)");
}

/// A server that has one transfer open at most: meanwhile it refuses every request, and it hears no abort of
/// another entry.
struct OneTransfer {
  std::optional<Multiplexer> open;

  /// Whether that was all there is to say to this frame.
  bool keeps(ScriptedDevice& self, const can::Frame& frame) {
    const bool aborts = frame.data[0] == 0x80;
    if (aborts && open == canopen::sdo_multiplexer(frame.bytes())) open.reset();
    if (!aborts && open) self.abort(frame, 0x08000022);
    return aborts || open;
  }
};

can::CapturedFrame seen(BusTime time, can::Direction direction, CanId id,
                        std::initializer_list<std::uint8_t> bytes) {
  return {can::data_frame(id, bytes), time, direction, {}};
}

}  // namespace

TEST_CASE("behind a case that moved the emergency messages they are looked for where they are again") {
  ScriptedDevice device;
  give_errors(device);
  const auto out = play(device, R"(
  - id: moves
    title: t
    risk: config
    steps:
      - set_cob_id: {object: 1014h:00, to: 6A0h}
        checks: T-MUST
  - id: looks
    title: t
    risk: config
    steps:
      - download: {object: 2000h:00, bytes: "01"}
      - frame: {id: emcy, within: 100 ms}
        checks: T-MUST
)");
  CHECK(out.verdict_of("T-MUST", 1) == Verdict::pass);
}

TEST_CASE("what the inhibit time of a case holds back is over before the next case begins") {
  ScriptedDevice device;
  give_errors(device);
  const auto out = play_before_another(device, R"(
      - download: {object: 1015h:00, value: 5000}  # 500 ms
      - download: {object: 2000h:00, bytes: "01"}
        checks: T-MUST
)");
  CHECK(between(out, some_emcy) >= 500ms);
}

TEST_CASE("what the inhibit time holds back is waited for where EMCY was sent on another CAN-ID as well") {
  ScriptedDevice device;
  give_errors(device, moved_emcy);
  const auto out = play_before_another(device, R"(
      - download: {object: 1015h:00, value: 5000}  # 500 ms
      - set_cob_id: {object: 1014h:00, to: 6A0h}
      - download: {object: 2000h:00, bytes: "01"}
        checks: T-MUST
)");
  CHECK(between(out, moved_emcy) >= 500ms);
}

TEST_CASE("the late end of an error is waited for where the error was told on another CAN-ID") {
  ScriptedDevice device;
  const can::Frame end = can::data_frame(CanId(0x81), {0, 0, 0, 0, 0, 0, 0, 0});
  give_errors(device, moved_emcy);
  device.before = [raise = device.before, end](ScriptedDevice& self, const can::Frame& frame, BusTime time) {
    if (frame.data[0] == 0x2F && frame.data[2] == 0x20 && frame.data[4] == 1) self.send_at(time + 300ms, end);
    return raise(self, frame, time);
  };
  const auto out = play_before_another(device, R"(
      - set_cob_id: {object: 1014h:00, to: 6A0h}
      - download: {object: 2000h:00, bytes: "01"}
        checks: T-MUST
)");
  CHECK(between(out, end) >= 0ms);
}

TEST_CASE("an inhibit time that a reset has ended holds up no further case") {
  ScriptedDevice device;
  give_errors(device);
  device.before = [raise = device.before](ScriptedDevice& self, const can::Frame& frame, BusTime time) {
    // What the reset behind it does to the entry.
    if (frame.data[0] == 0x2F && frame.data[2] == 0x20 && frame.data[4] == 2) self.entries[0x101500] = {0, 0};
    return raise(self, frame, time);
  };
  const auto out = play_before_another(device, R"(
      - download: {object: 1015h:00, value: 60000}  # 6 s
      - download: {object: 2000h:00, bytes: "01"}
        checks: T-MUST
      - download: {object: 2000h:00, bytes: "02"}
      - reset: communication
)");
  REQUIRE(out.run.cases.size() == 2);
  CHECK(out.run.cases[1].begin - out.run.cases[0].begin < 3s);
}

TEST_CASE("a request that a case sent as a frame has opened nothing when the next case begins") {
  // A server with a transfer open refuses to begin another one.
  ScriptedDevice device;
  bool open = false;
  device.before = [&open](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] == 0x80) open = false;
    if (frame.data[0] != 0xA0) return false;
    if (open) self.abort(frame, 0x08000022);
    if (!open) self.send(can::data_frame(CanId(0x581), {0xC2, 0x00, 0x10, 0, 4, 0, 0, 0}));
    open = true;
    return true;
  };
  const std::string opens = R"(
    title: t
    risk: motion
    steps:
      - send: {id: 600h + N, data: "A0 00 10 00 14 00 00 00"}
      - frame: {id: 580h + N, within: 100 ms}
        checks: T-MUST
        expect: {mask: FFh, value: C2h}
)";
  const auto out = play(device, "\n  - id: a" + opens + "\n  - id: b" + opens);
  CHECK(out.verdict_of("T-MUST", 0) == Verdict::pass);
  CHECK(out.verdict_of("T-MUST", 1) == Verdict::pass);
}

TEST_CASE("of many requests the one that the server confirmed last is ended by its name") {
  // It opens a transfer of 1001h only.
  ScriptedDevice device;
  OneTransfer server;
  device.before = [&server](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (server.keeps(self, frame)) return true;
    if (frame.data[0] != 0xA0) return false;
    const auto object = canopen::sdo_multiplexer(frame.bytes());
    if (object == Multiplexer{Index(0x1001), SubIndex(0)}) {
      self.send(can::data_frame(CanId(0x581), {0xC2, 0x01, 0x10, 0, 4, 0, 0, 0}));
      server.open = object;
    } else {
      self.abort(frame, 0x08000022);
    }
    return true;
  };
  const auto out = play(device, R"(
  - id: many
    title: t
    risk: motion
    steps:
      - over: {index: [10h, 11h, 12h, 13h, 01h, 14h, 15h, 16h]}
        steps:
          - talk: "> 600+N: A0 {index:1} 10 00 14 00 00 00"
          - wait: 1 ms
      - silence: {of: 700h + N, for: 1 ms}
        checks: T-MUST
  - id: behind
    title: t
    risk: motion
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
)");
  CHECK(out.verdict_of("T-MUST", 1) == Verdict::pass);
}

TEST_CASE("a transfer that a slow server begins while late answers are awaited is ended, too") {
  // It takes 200 ms to open the first of many.
  ScriptedDevice device;
  OneTransfer server;
  bool begun = false;
  device.before = [&](ScriptedDevice& self, const can::Frame& frame, BusTime now) {
    if (server.keeps(self, frame)) return true;
    if (begun || frame.data[0] >> 5U != 1 || self.nmt.empty()) return false;
    begun = true;
    server.open = canopen::sdo_multiplexer(frame.bytes());
    self.send_at(now + 200ms, can::data_frame(CanId(0x581), {0x60, frame.data[1], frame.data[2],
                                                             frame.data[3], 0, 0, 0, 0}));
    return true;
  };
  const auto out = play(device, R"(
  - id: many
    title: t
    risk: motion
    steps:
      - nmt: start
      - wait: 10 ms
      - noise: {frames: 50, every: 1 ms}
      - upload: {object: 1000h:00}
        checks: T-MUST
)");
  REQUIRE(begun);
  CHECK(out.verdict_of("T-MUST") == Verdict::pass);
}

TEST_CASE("an entry that came to be after the survey has the type that the standard gives it") {
  ScriptedDevice device;
  device.entries[0x100300] = {0};
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] == 0x2B) self.entries[0x100302] = {0, 0, 0, 0};
    return false;
  };
  const auto out = play(device, R"(
  - id: field
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
      - upload: {object: 1003h:02}
        checks: T-MUST
        expect: {value: 0}
      - download: {object: 1003h:02, value: 0}
        checks: T-OTHER
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::pass);
  CHECK(out.verdict_of("T-OTHER") == Verdict::pass);
}

TEST_CASE("a device with a node-ID that LSS gave it is nobody else, and who was heard there before is") {
  const auto sent = can::Direction::transmitted, received = can::Direction::received;
  const auto at = [](int ms) { return BusTime{} + Duration(ms * 1'000'000); };
  for (const bool before : {false, true}) {
    Others others(NodeId(1));
    can::Capture capture;
    capture.add(seen(at(0), received, CanId(0x701), {0x7F}));
    if (before) capture.add(seen(at(1), received, CanId(0x77D), {0x05}));
    capture.add(seen(at(2), sent, canopen::lss_request_can_id, {0x11, 0x7D, 0, 0, 0, 0, 0, 0}));
    CHECK(others.heard(capture).has_value() == before);
    capture.add(seen(at(3), received, canopen::lss_response_can_id, {0x11, 0, 0, 0, 0, 0, 0, 0}));
    capture.add(seen(at(4), received, CanId(0x77D), {0x00}));
    CHECK(others.heard(capture).has_value() == before);
    // Of another node-ID that the device did not take.
    capture.add(seen(at(5), sent, canopen::lss_request_can_id, {0x11, 0x7E, 0, 0, 0, 0, 0, 0}));
    capture.add(seen(at(6), received, canopen::lss_response_can_id, {0x11, 1, 0, 0, 0, 0, 0, 0}));
    capture.add(seen(at(7), received, CanId(0x77E), {0x00}));
    CHECK(others.heard(capture).has_value());
  }
}

TEST_CASE("a SYNC that goes on with the CAN-ID that 1005h was given is nobody else's") {
  const auto sent = can::Direction::transmitted, received = can::Direction::received;
  const auto at = [](int ms) { return BusTime{} + Duration(ms * 1'000'000); };
  for (const std::uint8_t low : {std::uint8_t{0x9E}, std::uint8_t{0x80}}) {
    // 69Eh, and 080h, with which anybody may send SYNC.
    const auto high = static_cast<std::uint8_t>(low == 0x80 ? 0 : 6);
    Others others(NodeId(1));
    can::Capture capture;
    capture.add(seen(at(0), sent, CanId(0x601), {0x23, 0x05, 0x10, 0x00, low, high, 0, 0}));
    capture.add(seen(at(1), received, CanId(0x581), {0x60, 0x05, 0x10, 0x00, 0, 0, 0, 0}));
    capture.add(seen(at(2), received, CanId(std::uint32_t{high} << 8U | low), {}));
    CHECK(others.heard(capture).has_value() == (low == 0x80));
  }
}

TEST_CASE(
    "EMCYs that come late behind a long inhibit time come before the next case, also where some errors have none") {
  ScriptedDevice device;
  device.entries[0x200000] = {0};
  device.entries[0x101500] = {0xE8, 0x03};  // 100 ms
  BusTime due{};
  device.before = [&due](ScriptedDevice& self, const can::Frame& frame, BusTime now) {
    // Each write of 2 is an error with a message, 50 ms late, and 100 ms behind the one before.
    if (frame.data[0] != 0x2F || frame.data[2] != 0x20 || frame.data[4] != 2) return false;
    due = std::max(now + 50ms, due + 100ms);
    self.send_at(due, some_emcy);
    return false;
  };
  auto profile = device::default_profile(NodeId(1));
  profile.errors.resize(2);
  for (const std::size_t i : {0U, 1U}) {
    device::TriggerWrite raise, clear;
    raise.object = clear.object = {Index(0x2000), SubIndex(0)};
    raise.bytes = {static_cast<std::uint8_t>(i + 1)};
    clear.bytes = {0};
    profile.errors[i].code = static_cast<std::uint16_t>(0x1000 + i);
    profile.errors[i].raise = raise;
    profile.errors[i].clear = clear;
    profile.errors[i].heartbeat_node.reset();
  }
  std::string cases;
  for (const std::string trigger : {"1", "1", "1", "1", "2"}) {
    cases += "  - id: a" + std::to_string(cases.size()) + "\n    title: t\n    risk: config\n    steps:\n" +
             "      - raise_error: " + trigger + "\n      - clear_error: " + trigger +
             "\n      - upload: {object: 1000h:00}\n        checks: T-OTHER\n";
  }
  can::SimulatedBus bus;
  const auto out = play(bus, device, cases + R"(
  - id: last
    title: t
    risk: config
    steps:
      - silence: {of: emcy, for: 300 ms}
        checks: T-MUST
)",
                        {}, profile);
  CHECK(out.verdict_of("T-MUST", 5) == Verdict::pass);
}
