// SPDX-License-Identifier: Apache-2.0
// SDO transfers, faults and channels, seen through whole runs and sessions on the simulated bus.
#include <deque>

#include "bench.hpp"
#include "can/frame_time.hpp"
#include "canopen/tests/scripted_server.hpp"
#include "engine/run_session.hpp"
#include "steps/sdo_step.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using conform::testing::ScriptedServer;
using result::Verdict;
using namespace std::chrono_literals;

namespace {

constexpr Multiplexer buffer{Index(0x2010), SubIndex(0)};

/// Puts the object 2010h with block transfers into a scripted device, on one more channel if wanted.
struct BlockDevice {
  ScriptedDevice device;
  ScriptedServer server;
  bool active = false;
  std::size_t frames_in_transfer = 0;

  BlockDevice() {
    device.before = [this](ScriptedDevice& on, const can::Frame& frame, BusTime) {
      const bool initiates = frame.data[1] == 0x10 && frame.data[2] == 0x20 &&
                             ((frame.data[0] & 0xE3U) == 0xA0 || (frame.data[0] & 0xE1U) == 0xC0);
      if (initiates) active = true;
      if (!active) return false;
      ++frames_in_transfer;
      for (const auto& answer : server.on_request(frame.data.data(), frame.size()))
        on.send(can::data_frame(CanId(0x581), answer));
      if (server.idle()) active = false;
      return true;
    };
  }
};

/// A second SDO server of the same kind on other CAN-IDs.
class SecondServer final : public can::Participant {
 public:
  ScriptedServer server;
  void attach(Sender sender, BusTime) override { send_ = std::move(sender); }
  void on_time(BusTime) override {}
  [[nodiscard]] std::optional<BusTime> next_wakeup() const override { return std::nullopt; }
  void on_frame(const can::Frame& frame, BusTime) override {
    if (!frame.is_data(CanId(0x641))) return;
    for (const auto& answer : server.on_request(frame.data.data(), frame.size()))
      send_(can::data_frame(CanId(0x5C1), answer));
  }

 private:
  Sender send_;
};

std::string steps_of(const std::string& steps) {
  return "  - id: a\n    title: t\n    risk: motion\n    steps:\n" + steps;
}

std::size_t requests(const can::Capture& capture, std::uint8_t command) {
  return static_cast<std::size_t>(std::ranges::count_if(capture.frames(), [command](const auto& each) {
    return each.frame.is_data(CanId(0x601)) && each.frame.data[0] == command;
  }));
}

/// A session without a run around it.
struct Bench {
  can::SimulatedBus bus;
  device::Profile profile = writing_profile();
  std::optional<Recorder> recorder;
  std::optional<RunSession> session;
  explicit Bench(const can::SimulatedBus::Options& options = {}) : bus(options) {}
  void attach(can::Participant& participant) {
    bus.attach(participant, "device");
    recorder.emplace(bus.transport(), nullptr);
    session.emplace(*recorder, profile, device::dictionary_of(profile));
    session->begin_case(scenario::Risk::motion);
  }
};

}  // namespace

TEST_CASE("a pattern goes down by block and comes back by block") {
  BlockDevice device;
  const auto out = play(device.device, steps_of(R"(
      - download: {object: 2010h:00, pattern: 1000 bytes, transfer: block, save: written}
        checks: T-MUST
        expect: {segments: 143, acks: 2, crc_agreed: 1, retransmitted: 0}
      - upload: {object: 2010h:00, transfer: block, blksize: 20}
        checks: T-MUST
        expect: {value: $written, crc_ok: 1, unused: 1, sub_blocks: 8, announced: 1000, wrong_numbers: 0}
)"));
  INFO(out.only().reason);
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(device.server.data == steps::pattern_bytes(1000, false));
}

TEST_CASE("a lost segment is measured, and the data are right in the end") {
  BlockDevice device;
  const auto out = play(device.device, steps_of(R"(
      - download: {object: 2010h:00, pattern: 100 bytes, transfer: block, fault: lose segment 2, save: written}
        checks: T-MUST
        expect: {first_ackseq: 1, retransmitted: 14, surplus: 0}
      - upload: {object: 2010h:00, transfer: block, fault: [lose segment 5, lose segment 7]}
        checks: T-MUST
        expect: {value: $written, retransmitted: 1..}
)"));
  INFO(out.only().reason);
  CHECK(out.only().verdict == Verdict::pass);
}

TEST_CASE("a fault without a place judges nothing") {
  BlockDevice device;
  device.server.data = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const auto out = play(device.device, steps_of(R"(
      - upload: {object: 2010h:00, transfer: block, fault: abort after segment 9}
        checks: T-MUST
        expect: ok
)"));
  CHECK(out.only().verdict == Verdict::inconclusive);
  CHECK(out.only().reason.find(
            "the transfer has 2 segments only: 'abort after segment 9' has no place in it") !=
        std::string::npos);
  const auto none = play(device.device, steps_of(R"(
      - download: {object: 1017h:00, value: 1, fault: lose segment 1}
        checks: T-MUST
        expect: ok
)"));
  CHECK(none.only().verdict == Verdict::inconclusive);
  CHECK(none.only().reason.find("the transfer has 0 segments only") != std::string::npos);
}

TEST_CASE("what a server says after the client's abort is counted") {
  BlockDevice device;
  device.server.data = Bytes(300, 7);
  const auto out = play(device.device, steps_of(R"(
      - upload: {object: 2010h:00, transfer: block, fault: abort after segment 3}
        checks: T-MUST
        expect: {surplus: 0..60, answers: 0}
      - upload: {object: 1000h:00}
        checks: T-MUST
        expect: {size: 4}
)"));
  INFO(out.only().reason);
  CHECK(out.only().verdict == Verdict::pass);
}

TEST_CASE("what a server still says to the segments behind its abort is heard out before the next request") {
  // Its answers wait behind another frame of its own until the client's segments leave room on the bus.
  ScriptedDevice device;
  std::optional<BusTime> free_at;
  std::size_t answers = 0;
  device.before = [&](ScriptedDevice& on, const can::Frame& frame, BusTime now) {
    const auto say = [&](std::initializer_list<std::uint8_t> bytes) {
      on.send_at(*free_at + ++answers * 1ms, can::data_frame(CanId(0x581), bytes));
    };
    if ((frame.data[0] & 0xE1U) == 0xC0 && frame.data[1] == 0x10) {
      on.send(can::data_frame(CanId(0x581), {0xA0, 0x10, 0x20, 0, 127, 0, 0, 0}));
      free_at = now + 60ms;
      return true;
    }
    if (!free_at || answers > 127) return false;
    if (answers == 127) {
      say({0x43, 0x00, 0x10, 0, 0x91, 1, 0, 0});
    } else if (answers == 0) {
      say({0x80, 0x10, 0x20, 0, 0x12, 0, 0x07, 0x06});
    } else {
      say({0x80, 0, 0, 0, 0x01, 0, 0x04, 0x05});
    }
    return true;
  };
  const auto out = play(device, steps_of(R"(
      - download: {object: 2010h:00, pattern: 889 bytes, transfer: block}
        either: [{if: ok}, {if: abort any}]
      - talk: "> 600+N: 40 00 10 00 00 00 00 00"
        checks: T-MUST
        either:
          - talk: "< 580+N: 43 00 10 00 .."
)"));
  INFO(out.only().reason);
  CHECK(out.only().verdict == Verdict::pass);
}

TEST_CASE("after the client fell silent the next step finds the channel as it is") {
  BlockDevice device;
  device.server.data = Bytes(300, 7);
  const auto out = play(device.device, steps_of(R"(
      - upload: {object: 2010h:00, transfer: block, blksize: 1, fault: silence after segment 1, wait: 50 ms}
        expect: silence
      - upload: {object: 1000h:00}
        checks: T-MUST
        expect: {size: 4, value: 0191h}
)"));
  INFO(out.only().reason);
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(requests(out.capture, 0x80) == 0);
}

TEST_CASE("a server's abort within a sub-block is heeded at once") {
  BlockDevice device;
  device.server.abort_at_segment = 3;
  const auto out = play(device.device, steps_of(R"(
      - download: {object: 2010h:00, pattern: 2000 bytes, transfer: block}
        checks: T-MUST
        expect: abort 0800 0020h
)"));
  CHECK(out.only().verdict == Verdict::pass);
  const auto segments = std::ranges::count_if(out.capture.frames(), [](const auto& each) {
    return each.frame.is_data(CanId(0x601)) && each.frame.data[0] >= 1 && each.frame.data[0] < 0x20;
  });
  CHECK(segments < 20);
}

namespace {

/// A host that stands still before it sends the request that `is_it` picks, the first time: whatever comes
/// meanwhile waits for it.
class StandingStill final : public can::Transport {
 public:
  using Pick = std::function<bool(const can::Frame&)>;
  StandingStill(can::Transport& inner, Duration pause, Pick is_it)
      : inner_(inner), pause_(pause), is_it_(std::move(is_it)) {}
  BusTime now() const override { return inner_.now(); }
  Result<void> send(const can::Frame& frame) override {
    if (is_it_ && is_it_(frame)) {
      is_it_ = nullptr;
      const auto until = inner_.now() + pause_;
      for (;;) {
        auto event = inner_.receive(until);
        if (!event) return std::unexpected(event.error());
        if (!*event) break;
        waiting_.push_back(**event);
      }
    }
    return inner_.send(frame);
  }
  Result<std::optional<can::BusEvent>> receive(BusTime deadline) override {
    if (waiting_.empty() || waiting_.front().time > deadline) return inner_.receive(deadline);
    auto out = waiting_.front();
    waiting_.pop_front();
    return out;
  }
  can::BusHealth health() override { return inner_.health(); }
  can::TransportInfo info() const override { return inner_.info(); }

 private:
  can::Transport& inner_;
  Duration pause_;
  Pick is_it_;
  std::deque<can::BusEvent> waiting_;
};

/// A download by block of which the host sends segment 5 late, to a device that gives it up at segment 5
/// whenever `gives_up` says so.
Outcome play_standing_still(Duration pause, bool gives_up_each_time) {
  BlockDevice device;
  can::SimulatedBus bus;
  bus.attach(device.device, "scripted device");
  const auto is_segment = [](const can::Frame& frame) { return frame.id == 0x601 && frame.data[0] == 5; };
  StandingStill transport(bus.transport(), pause, [&](const can::Frame& frame) {
    device.server.abort_at_segment = 5;
    return is_segment(frame);
  });
  const auto inner = device.device.before;
  device.device.before = [&](ScriptedDevice& on, const can::Frame& frame, BusTime now) {
    const bool done = inner(on, frame, now);
    if (is_segment(frame) && !gives_up_each_time) device.server.abort_at_segment = 0;
    return done;
  };
  const auto suite = suite_of(steps_of(R"(
      - download: {object: 2010h:00, pattern: 100 bytes, transfer: block}
        checks: T-MUST
)"));
  Outcome out;
  out.run = run(transport, writing_profile(), suite, catalogue(), {}, out.capture);
  return out;
}

}  // namespace

TEST_CASE("a server that loses patience with a host standing still in a sub-block violates nothing") {
  const auto out = play_standing_still(300ms, false);
  INFO(out.only().reason);
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(out.only().tried.starts_with("2 times"));
}

TEST_CASE("a server that gives up a download also when the host is in time is failed") {
  CHECK(play_standing_still(300ms, true).only().verdict == Verdict::fail);
  // So short a pause is nothing that a server may take for the end of the transfer.
  const auto in_time = play_standing_still(50ms, false);
  CHECK(in_time.only().verdict == Verdict::fail);
  CHECK(in_time.only().tried.empty());
}

TEST_CASE("harmless traffic between request and answer changes nothing") {
  BlockDevice device;
  const auto inner = device.device.before;
  device.device.before = [inner](ScriptedDevice& on, const can::Frame& frame, BusTime now) {
    on.send(can::data_frame(CanId(0x701), {0x05}));                          // heartbeat
    on.send(can::data_frame(CanId(0x081), {0, 0x10, 1, 0, 0, 0, 0, 0}));     // EMCY
    on.send(can::data_frame(CanId(0x181), {1, 2, 3, 4, 5, 6, 7, 8}));        // TPDO
    on.send(can::data_frame(CanId(0x582), {0x80, 0, 0x10, 0, 0, 0, 0, 8}));  // another node's SDO
    can::Frame remote;
    remote.id = 0x581;
    remote.remote = true;
    on.send(remote);
    return inner(on, frame, now);
  };
  const auto out = play(device.device, steps_of(R"(
      - download: {object: 2010h:00, pattern: 200 bytes, transfer: block, save: written}
        checks: T-MUST
      - upload: {object: 2010h:00, transfer: block}
        checks: T-MUST
        expect: {value: $written}
      - upload: {object: 1000h:00}
        checks: T-MUST
        expect: {size: 4}
)"));
  INFO(out.only().reason);
  CHECK(out.only().verdict == Verdict::pass);
}

TEST_CASE("another SDO client on the channel makes the case inconclusive") {
  BlockDevice device;
  SecondServer other;
  can::SimulatedBus bus;
  bus.attach(other, "other node");
  const auto inner = device.device.before;
  device.device.before = [&](ScriptedDevice& on, const can::Frame& frame, BusTime now) {
    // Once, in the middle of the case: as if the other node asked our device.
    if (frame.data[0] == 0x40 && frame.data[1] == 0x17)
      on.send(can::data_frame(CanId(0x601), {0x40, 0, 0x10, 0, 0, 0, 0, 0}));
    return inner(on, frame, now);
  };
  const auto out = play(bus, device.device, steps_of(R"(
      - upload: {object: 1017h:00}
        checks: T-MUST
)"));
  CHECK(out.only().verdict == Verdict::inconclusive);
  CHECK(out.only().reason == "another SDO client used the channel during the case");
}

TEST_CASE("an answer that is late is never taken for the answer to another request") {
  ScriptedDevice device;
  std::optional<can::Frame> kept;
  // 1001h is answered only when 1000h is asked for, in front of the right answer and past every rest.
  device.before = [&kept](ScriptedDevice& on, const can::Frame& frame, BusTime) {
    if (frame.data[0] == 0x40 && frame.data[1] == 0x01 && frame.data[2] == 0x10) {
      kept = can::data_frame(CanId(0x581), {0x4F, 0x01, 0x10, 0x00, 0x00, 0, 0, 0});
      return true;
    }
    if (kept && frame.data[0] == 0x40) {
      on.send(*kept);
      kept.reset();
    }
    return false;
  };
  Bench bench;
  bench.attach(device);
  const auto silent = bench.session->upload({Index(0x1001), SubIndex(0)}, std::nullopt);
  REQUIRE(silent);
  CHECK(silent->kind == steps::SdoAnswer::Kind::silence);
  const auto answered = bench.session->upload({Index(0x1000), SubIndex(0)}, std::nullopt);
  REQUIRE(answered);
  CHECK(answered->kind == steps::SdoAnswer::Kind::confirmed);
  CHECK(answered->data == Bytes{0x91, 0x01, 0, 0});
}

TEST_CASE("a server that sends the client's aborts back is not taken for a slow one") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& on, const can::Frame& frame, BusTime) {
    if (frame.data[0] == 0x80) on.send(can::data_frame(CanId(0x581), frame.bytes()));
    return frame.data[0] == 0x80 || (frame.data[0] == 0x40 && frame.data[1] == 0x01);
  };
  Bench bench;
  bench.attach(device);
  const auto begin = bench.session->now();
  for (int round = 0; round < 5; ++round) {
    REQUIRE(bench.session->upload({Index(0x1001), SubIndex(0)}, std::nullopt));
    REQUIRE(bench.session->upload({Index(0x1000), SubIndex(0)}, std::nullopt));
  }
  CHECK(bench.session->now() - begin < 30s);
}

TEST_CASE("transfers on two channels run side by side and end on their own") {
  BlockDevice device;
  SecondServer second;
  can::SimulatedBus bus;
  bus.attach(second, "second server");
  const auto out = play(bus, device.device, steps_of(R"(
      - interleave:
          - download: {object: 2010h:00, pattern: 300 bytes, transfer: block, save: one}
          - download: {object: 2010h:00, pattern: 200 bytes, transfer: block, channel: {request: 640h + N, response: 5C0h + N}, save: two}
        checks: T-MUST
        expect: {count: 2}
      - interleave:
          - upload: {object: 2010h:00, transfer: block}
          - upload: {object: 2010h:00, transfer: block, blksize: 200, channel: {request: 641h, response: 5C1h}}
        checks: T-OTHER
        expect: abort 0504 0002h
)"));
  INFO(out.only().reason);
  CHECK(out.verdict_of("T-MUST") == Verdict::pass);
  CHECK(device.server.data == steps::pattern_bytes(300, false));
  CHECK(second.server.data == steps::pattern_bytes(200, false));
  // Their frames alternate: neither waited for the other's end.
  std::size_t changes = 0;
  std::uint32_t last = 0;
  for (const auto& each : out.capture.frames()) {
    if (each.direction != can::Direction::transmitted || (each.frame.id != 0x601 && each.frame.id != 0x641))
      continue;
    if (each.frame.id != last) ++changes;
    last = each.frame.id;
  }
  CHECK(changes > 20);
}

TEST_CASE("two transfers on one channel are a mistake of the scenario") {
  BlockDevice device;
  const auto out = play(device.device, steps_of(R"(
      - interleave:
          - upload: 1000h:00
          - upload: 1001h:00
        checks: T-MUST
)"));
  CHECK(out.only().verdict == Verdict::inconclusive);
  CHECK(out.only().reason.find("two transfers at the same time on the channel 601h") != std::string::npos);
}

TEST_CASE("block transfers use the bus to the full, whatever its bit rate") {
  for (const std::uint32_t bit_rate : {125'000U, 1'000'000U}) {
    for (const bool upload : {false, true}) {
      Bench bench({.bit_rate = bit_rate, .queue_limit = 200});
      BlockDevice device;
      device.server.data = steps::pattern_bytes(100'000, false);
      bench.attach(device.device);
      canopen::SdoRequest request{.upload = upload, .object = buffer, .block = true};
      if (!upload) request.data = device.server.data;
      const auto begin = bench.recorder->capture().size();
      const auto answers = bench.session->transfer({{.request = request}});
      REQUIRE(answers);
      CHECK(answers->front().kind == steps::SdoAnswer::Kind::confirmed);
      const auto& frames = bench.recorder->capture().frames();
      Duration on_the_bus{};
      for (auto i = begin; i < frames.size(); ++i)
        on_the_bus += can::bit_time(can::frame_bits(frames[i].frame) + can::intermission_bits, bit_rate);
      const auto elapsed = frames.back().time - frames[begin].time;
      const auto share = static_cast<double>(on_the_bus.count()) / static_cast<double>(elapsed.count());
      INFO(bit_rate << " bit/s, " << (upload ? "upload" : "download"));
      CHECK(share > 0.95);
    }
  }
}

TEST_CASE("a megabyte goes both ways within the capture's bounds") {
  Bench bench({.bit_rate = 1'000'000, .queue_limit = 200});
  BlockDevice device;
  bench.attach(device.device);
  const auto data = steps::pattern_bytes(1'000'000, false);
  const auto down = bench.session->transfer(
      {{.request = {.upload = false, .object = buffer, .data = data, .block = true}}});
  REQUIRE(down);
  CHECK(down->front().kind == steps::SdoAnswer::Kind::confirmed);
  const auto up = bench.session->transfer({{.request = {.object = buffer, .block = true}}});
  REQUIRE(up);
  CHECK(up->front().data == data);
  CHECK(bench.recorder->capture().size() < 300'000);
}

TEST_CASE("a request whose echo the host lost was sent all the same, and the run goes on") {
  for (const bool conversation : {false, true}) {
    can::SimulatedBus bus;
    ScriptedDevice device;
    device.before = [&](ScriptedDevice&, const can::Frame& frame, BusTime) {
      // Behind this request come its answer and then the frame whose echo is lost.
      if (frame.data[1] == 0x14) bus.drop_at_harness(bus.frame_count() + 2);
      return false;
    };
    const auto out = play(bus, device,
                          steps_of(std::string(R"(
      - upload: {object: 1014h:00}
)") + (conversation ? R"(
      - talk: "> 600+N: 40 17 10 00 00 00 00 00"
        checks: T-MUST
)"
                    : R"(
      - upload: {object: 1017h:00}
        checks: T-MUST
)")));
    INFO(conversation);
    CHECK_FALSE(out.run.aborted.has_value());
    CHECK(out.only().verdict == Verdict::inconclusive);
    CHECK(out.only().reason.find("the host lost") != std::string::npos);
  }
}

TEST_CASE("an upload that would take a day is given up and judges nothing") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime now) {
    const auto command = frame.data[0];
    if (command == 0x40 && frame.data[1] == 0x08) {
      self.send(can::data_frame(CanId(0x581), {0x41, 0x08, 0x10, 0x00, 0x00, 0x00, 0x10, 0x00}));
      return true;
    }
    if (command != 0x60 && command != 0x70) return false;
    // One byte of 1 MiB, just in time.
    const auto segment = static_cast<std::uint8_t>((command & 0x10U) | 0x0CU);
    self.send_at(now + std::chrono::milliseconds(900),
                 can::data_frame(CanId(0x581), {segment, 0x41, 0, 0, 0, 0, 0, 0}));
    return true;
  };
  const auto out = play(bus, device, steps_of(R"(
      - upload: {object: 1008h:00}
        checks: T-MUST
)"));
  INFO(out.only().reason);
  for (const auto& each : out.only().judgements) {
    for (const auto& finding : each.findings) UNSCOPED_INFO(finding.actual + " " + finding.reason);
  }
  CHECK(out.only().verdict == Verdict::inconclusive);
  // Looked at twice before the case begins.
  CHECK(out.run.elapsed < std::chrono::minutes(10));
}

TEST_CASE("what a device has under another node-ID for a while is not where its EMCY is looked for later") {
  /// Has node-ID 7Dh for one request, and tells of an error with every write to its heartbeat time.
  class Moved final : public ScriptedDevice {
   public:
    void on_frame(const can::Frame& frame, BusTime now) override {
      if (frame.is_data(CanId(0x67D)))
        send(can::data_frame(CanId(0x5FD), {0x43, 0x14, 0x10, 0x00, 0xFD, 0x00, 0x00, 0x00}));
      if (frame.is_data(CanId(0x601)) && frame.data[0] == 0x2B)
        send(can::data_frame(CanId(0x081), {0x00, 0x10, 0x01, 0, 0, 0, 0, 0}));
      ScriptedDevice::on_frame(frame, now);
    }
  } device;
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: motion
    steps:
      - upload: {object: 1014h:00, channel: {request: 67Dh, response: 5FDh}}
        checks: T-OTHER
        expect: {value: FDh}
      - upload: {object: 1000h:00}
      - download: {object: 1017h:00, value: 0}
        as: written
      - frame: {id: emcy error, within: 100 ms, after: written}
        checks: T-MUST
        expect: ok
)");
  CHECK(out.only().verdict == Verdict::pass);
}
