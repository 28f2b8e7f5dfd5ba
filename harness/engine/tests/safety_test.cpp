// SPDX-License-Identifier: Apache-2.0
// What must hold whatever happens: values are put back, faults of the world are no verdicts, nothing is sent
// unasked.
#include <csignal>
#include <map>

#include "bench.hpp"
#include "device/standard_objects.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using namespace std::chrono_literals;
using result::Verdict;

namespace {

const std::string three_reads = R"(
  - id: first
    title: t
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
  - id: second
    title: t
    steps:
      - upload: {object: 1001h:00}
        checks: T-MUST
  - id: third
    title: t
    steps:
      - upload: {object: 1018h:01}
        checks: T-MUST
)";

}  // namespace

TEST_CASE("a changed value is put back after the case") {
  ScriptedDevice device;
  const auto out = play(device, change_1017);
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(device.writes == std::vector<std::string>{"1017h = E8 03", "1017h = 00 00"});
  CHECK(device.entries.at(0x101700) == std::vector<std::uint8_t>{0, 0});
  CHECK(out.run.notes.empty());
}

TEST_CASE("a cleanup that stores does not store what else the case has changed") {
  ScriptedDevice device;
  device.entries[0x101001] = {1, 0, 0, 0};
  device.entries[0x101200] = {0x00, 0x01, 0, 0};
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: nvm
    steps:
      - download: {object: 1012h:00, value: 200h}
      - download: {object: 1017h:00, value: 1000}
        checks: T-MUST
    cleanup:
      - download: {object: 1012h:00, value: 100h}
      - download: {object: 1010h:01, value: 6576 6173h}
)");
  CHECK(out.only().verdict == Verdict::pass);
  REQUIRE(device.writes.size() >= 5);
  CHECK(std::vector(device.writes.begin(), device.writes.begin() + 5) ==
        std::vector<std::string>{"1012h = 00 02 00 00", "1017h = E8 03", "1012h = 00 01 00 00",
                                 "1017h = 00 00", "1010h = 73 61 76 65"});
}

TEST_CASE("an entry the profile calls untouchable is never written, whatever a scenario says") {
  auto profile = device::default_profile(NodeId(1));
  profile.untouchable.push_back({Index(0x1017), SubIndex(0)});
  can::SimulatedBus bus;
  ScriptedDevice device;
  const auto out = play(bus, device, change_1017 + R"(
  - id: walk
    title: t
    risk: config
    for_each: {entry: entries with index 1017h}
    steps:
      - download: {object: $entry, value: 5}
        checks: T-MUST
  - id: condition
    title: t
    risk: config
    when: 1017h:00 is writable
    steps:
      - upload: {object: 1017h:00}
        checks: T-MUST
)",
                        {}, profile);
  CHECK(device.writes.empty());
  REQUIRE(out.run.cases.size() == 3);
  CHECK(out.run.cases[0].verdict == Verdict::inconclusive);
  CHECK(out.run.cases[1].verdict == Verdict::not_applicable);
  CHECK(out.run.cases[2].verdict == Verdict::not_applicable);
}

TEST_CASE("a COB-ID is put back by switching it off, changing it and switching it on") {
  ScriptedDevice device;
  (void)play(device, R"(
  - id: change
    title: t
    risk: config
    steps:
      - set_cob_id: {object: 1014h:00, to: 6A0h}
        checks: T-MUST
)");
  CHECK(device.writes == std::vector<std::string>{"1014h = 81 00 00 80", "1014h = A0 06 00 80",
                                                  "1014h = A0 06 00 00", "1014h = A0 06 00 80",
                                                  "1014h = 81 00 00 80", "1014h = 81 00 00 00"});
}

TEST_CASE("what is changed only while values are put back is told before and settled after") {
  /// What a killed run would leave to be put back.
  class Ledger final : public Observer {
   public:
    void changing(Multiplexer object, const Bytes& before) override { open_.try_emplace(object, before); }
    void put_back(Multiplexer object, const Bytes& value) override {
      const auto found = open_.find(object);
      if (found != open_.end() && found->second == value) open_.erase(found);
    }
    [[nodiscard]] bool is_open(Multiplexer object) const { return open_.contains(object); }
    [[nodiscard]] bool is_empty() const { return open_.empty(); }

   private:
    std::map<Multiplexer, Bytes> open_;
  };
  const Multiplexer cob_id{Index(0x1400), SubIndex(1)}, count{Index(0x1600), SubIndex(0)};
  ScriptedDevice device;
  device.entries[0x140001] = {1, 2, 0, 0};
  device.entries[0x160000] = {1};
  device.entries[0x160001] = {8, 1, 0, 0x62};
  Ledger ledger;
  bool untold = false;
  device.before = [&](ScriptedDevice&, const can::Frame& frame, BusTime) {
    if ((frame.data[0] & 0xE0U) != 0x20) return false;
    const Multiplexer object = canopen::sdo_multiplexer(frame.bytes());
    if ((object == cob_id || object == count) && !ledger.is_open(object)) untold = true;
    return false;
  };
  RunOptions options;
  options.observer = &ledger;
  // The PDO is on again at the end, and its mapping is another one: to put that back it has to be off.
  const auto out = play(device, R"(
  - id: change
    title: t
    risk: config
    steps:
      - download: {object: 1400h:01, bytes: "01 02 00 80"}
      - download: {object: 1600h:01, bytes: "08 02 00 62"}
      - download: {object: 1400h:01, bytes: "01 02 00 00"}
        checks: T-MUST
)",
                        options);
  CAPTURE(device.writes, out.run.cases[0].reason);
  CHECK(device.writes.size() > 6);
  CHECK_FALSE(untold);
  CHECK(ledger.is_empty());
  CHECK(device.entries.at(0x140001) == Bytes{1, 2, 0, 0});
  CHECK(device.entries.at(0x160000) == Bytes{1});
  CHECK(device.entries.at(0x160001) == Bytes{8, 1, 0, 0x62});
}

TEST_CASE("a download hidden in a conversation is put back as well") {
  ScriptedDevice device;
  (void)play(device, R"(
  - id: change
    title: t
    risk: config
    steps:
      - talk: |
          > 600+N: 2B 17 10 00 E8 03 00 00
          < 580+N: 60 17 10 00 zz zz zz zz
        checks: T-MUST
)");
  CHECK(device.entries.at(0x101700) == std::vector<std::uint8_t>{0, 0});
}

TEST_CASE("a long value of a case is written over, and not read again before") {
  std::size_t reads = 0;
  ScriptedDevice device;
  device.entries[0x200000] = {1, 2, 3};
  // Takes segments without keeping them, and shows what it was given last by expedited transfers.
  device.before = [&reads](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    const bool begins = frame.data[0] == 0x21, segment = frame.data[0] < 0x20;
    if (frame.data[0] == 0x40 && frame.data[2] == 0x20) ++reads;
    if (!begins && !segment) return false;
    if (begins) self.entries[0x200000] = {9, 9, 9};
    auto answer = frame;
    answer.id = 0x581;
    answer.data[0] = static_cast<std::uint8_t>(begins ? 0x60U : 0x20U | (frame.data[0] & 0x10U));
    self.send(answer);
    return true;
  };
  (void)play(device, R"(
  - id: change
    title: t
    risk: config
    steps:
      - download: {object: 2000h:00, pattern: 2000 bytes}
        checks: T-MUST
)");
  CHECK(device.entries.at(0x200000) == std::vector<std::uint8_t>{1, 2, 3});
  CHECK(reads == 2);  // before the case wrote, and when it was put back
}

TEST_CASE("what an RPDO has written is put back as what a download has") {
  struct WithRpdo : ScriptedDevice {
    void on_frame(const can::Frame& frame, BusTime now) override {
      if (frame.is_data(CanId(0x201))) entries[0x101700] = {frame.data[0], frame.data[1]};
      ScriptedDevice::on_frame(frame, now);
    }
  } device;
  device.entries[0x140001] = {0x01, 0x02, 0, 0};
  device.entries[0x140002] = {0xFF};
  device.entries[0x160000] = {1};
  device.entries[0x160001] = {0x10, 0x00, 0x17, 0x10};
  const auto out = play(device, R"(
  - id: receive
    title: t
    risk: motion
    steps:
      - set_pdo: {pdo: 1400h:00, mapping: [1017h:00], type: FFh}
      - nmt: start
      - send: {id: 201h, data: "9A 02"}
      - upload: {object: 1017h:00}
        checks: T-MUST
        expect: {value: 029Ah}
)");
  REQUIRE(out.run.cases.size() == 1);
  CHECK(out.run.cases[0].verdict == Verdict::pass);
  CHECK(device.entries.at(0x101700) == std::vector<std::uint8_t>{0, 0});
}

TEST_CASE("a value that cannot be put back is said in the notes") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] != 0x2B || self.writes.empty()) return false;
    self.abort(frame, 0x08000000);
    return true;
  };
  const auto out = play(device, change_1017);
  CHECK_FALSE(out.run.notes.empty());
  CHECK(out.run.notes.front().find("1017h:00") != std::string::npos);
}

TEST_CASE("a device that holds what its description says is taken for one in which nothing is stored") {
  const std::string asks = R"(
  - id: a
    title: t
    risk: config
    when: factory defaults are active
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
)";
  auto entry = device::standard_entry({Index(0x1017), SubIndex(0)}).value();
  entry.default_value = Bytes{0, 0};
  entry.claimed = entry.declared_default = entry.described = true;
  const auto reason = [&asks](const std::vector<device::Entry>& described,
                              std::optional<bool> said = std::nullopt) {
    auto profile = device::default_profile(NodeId(1));
    profile.objects = described;
    profile.factory_defaults = said;
    can::SimulatedBus bus;
    ScriptedDevice device;
    const auto out = play(bus, device, asks, {}, profile);
    return out.only().verdict == Verdict::pass ? "" : out.only().reason;
  };
  const std::string nobody = "nobody says that factory defaults are active";
  CHECK(reason({entry}) == "");
  CHECK(reason({entry}, false) == nobody);
  CHECK(reason({}) == nobody + ": no description tells a default");
  auto other = entry;
  other.default_value = Bytes{0xE8, 3};
  CHECK(reason({other}) == nobody + ": 1017h:00 holds 00 00, and the description says E8 03");
  CHECK(reason({other}, true) == "");
  // Where it tells no default, what is not 0 may have been stored; a DCF tells what was.
  auto open = device::standard_entry({Index(0x1014), SubIndex(0)}).value();
  open.default_value.reset();
  open.claimed = true;
  CHECK(reason({entry, open}) ==
        nobody + ": 1014h:00 holds 81 00 00 00, and the description does not say what it holds at first");
  auto configured = entry;
  configured.configured = true;
  CHECK(reason({configured}) == nobody + ": 1017h:00 holds what the description sets it to");
}

TEST_CASE("after a value could not be put back nothing is said to be a factory default") {
  auto profile = device::default_profile(NodeId(1));
  profile.factory_defaults = true;
  const std::string defaults = R"(
  - id: defaults
    title: t
    risk: config
    steps:
      - upload: {object: 1017h:00}
        checks: T-MUST
        when: factory defaults are active
        expect: {value: 0}
      - upload: {object: 1017h:00}
        checks: T-MUST
        unless: factory defaults are active
        expect: {value: 0}
        warn: ok
)";
  can::SimulatedBus bus;
  ScriptedDevice device;
  // Takes one value and keeps it: a device that stores by itself and refuses what it had before.
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] != 0x2B || self.writes.empty()) return false;
    self.abort(frame, 0x08000000);
    return true;
  };
  const auto out = play(bus, device, change_1017 + defaults, {}, profile);
  REQUIRE(out.run.cases.size() == 2);
  CHECK(out.run.cases[1].verdict == Verdict::warn);
}

TEST_CASE("what a reset of all nodes brings back is put back before the next case") {
  auto profile = writing_profile();
  profile.claims.insert("autonomous storing");
  ScriptedDevice device;
  device.on_reset = [](ScriptedDevice& self) {
    if (!self.writes.empty()) self.entries[0x101700] = {0xE8, 0x03};
  };
  can::SimulatedBus bus;
  const auto out = play(bus, device, change_1017 + R"(
  - id: everybody
    title: t
    risk: motion
    steps:
      - talk: "> 000: 82 00"
      - boot_up: {within: 1 s}
        checks: T-OTHER
  - id: next
    title: t
    risk: motion
    steps:
      - upload: {object: 1017h:00}
        checks: T-MUST
        expect: {value: 0}
)",
                        {}, profile);
  REQUIRE(out.run.cases.size() == 3);
  CHECK(out.run.cases[2].verdict == Verdict::pass);
}

TEST_CASE("what a device restores wrongly fails the case about it and spoils none behind it") {
  ScriptedDevice device;
  device.entries[0x101100] = {1};
  device.entries[0x101101] = {1, 0, 0, 0};
  device.on_reset = [](ScriptedDevice& self) {
    if (self.entries.at(0x101101) == std::vector<std::uint8_t>{0x6C, 0x6F, 0x61, 0x64})
      self.entries[0x101400] = {0x80, 0, 0, 0};
    self.entries[0x101101] = {1, 0, 0, 0};
  };
  const auto out = play(device, R"(
  - id: restore
    title: t
    risk: nvm
    steps:
      - download: {object: 1011h:01, value: 6461 6F6Ch}
      - reset: node
      - upload: {object: 1014h:00}
        checks: T-OTHER
        expect: {value: 81h}
  - id: next
    title: t
    risk: nvm
    steps:
      - upload: {object: 1014h:00}
        checks: T-MUST
        expect: {value: 81h}
)");
  REQUIRE(out.run.cases.size() == 2);
  CHECK(out.run.cases[0].verdict == Verdict::fail);
  CHECK(out.run.cases[1].verdict == Verdict::pass);
}

TEST_CASE("when nothing is heard every case is an error, none a failure, and the exit code is 3") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  device.dead = true;
  const auto out = play(bus, device, three_reads);
  REQUIRE(out.run.cases.size() == 3);
  for (const auto& each : out.run.cases) CHECK(each.verdict == Verdict::error);
  CHECK(out.run.aborted.has_value());
  // Three requests, then a reset and the time that a device may take to boot.
  CHECK(out.run.elapsed < 25s);  // T_BOOT twice, and patience
  CHECK(result::exit_code(out.run) == 3);
}

TEST_CASE(
    "a device that is there but answers no SDO request fails the basic rule, and nothing else is judged") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice&, const can::Frame&, BusTime) { return true; };
  const auto out = play(device, R"(
  - id: other
    title: t
    steps:
      - upload: {object: 1000h:00}
        checks: T-OTHER
  - id: served
    title: t
    basic: true
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
)");
  REQUIRE(out.run.cases.size() == 2);
  CHECK(out.run.cases[0].id == "test/served");
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  CHECK(out.run.cases[1].verdict == Verdict::error);
  CHECK(result::exit_code(out.run) == 1);
}

TEST_CASE(
    "a device whose SDO server stays dead after a request has failed that rule, and the rest is not judged") {
  ScriptedDevice device;
  bool dead = false;
  device.before = [&dead](ScriptedDevice&, const can::Frame& frame, BusTime) {
    dead = dead || frame.data[0] == 0x2B;
    return dead;
  };
  const auto out = play(device, change_1017 + R"(
  - id: next
    title: t
    risk: motion
    steps:
      - upload: {object: 1000h:00}
        checks: T-OTHER
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  CHECK(out.run.cases[1].verdict == Verdict::error);
  CHECK(out.run.aborted.has_value());
}

TEST_CASE("when the device vanishes half-way what was judged stays and the rest neither passes nor fails") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    // Gone with the third read of 1001h:00: the preparation made two.
    const bool reads_1001 =
        frame.data[0] == 0x40 && frame.data[1] == 0x01 && frame.data[2] == 0x10 && frame.data[3] == 0;
    if (reads_1001 && self.writes.size() > 1) self.dead = true;
    if (reads_1001) self.writes.emplace_back("1001h was read");
    return self.dead;
  };
  const auto out = play(device, three_reads);
  REQUIRE(out.run.cases.size() == 3);
  CHECK(out.run.cases[0].verdict == Verdict::pass);
  CHECK(out.run.cases[1].verdict == Verdict::error);
  CHECK(out.run.cases[2].verdict == Verdict::error);
  CHECK(result::exit_code(out.run) == 3);
}

TEST_CASE("a device that hangs over a request and needs a reset has failed, and the run goes on") {
  ScriptedDevice device;
  bool hanging = false;
  device.before = [&hanging](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] == 0x2B) hanging = true;
    if (!self.nmt.empty() && self.nmt.back() >= 0x81) hanging = false;
    return hanging;
  };
  const auto out = play(device, change_1017 + three_reads);
  REQUIRE(out.run.cases.size() == 4);
  CHECK(out.run.cases[3].id == "test/change");
  CHECK(out.run.cases[3].verdict == Verdict::fail);
  CHECK_FALSE(out.run.aborted.has_value());
}

TEST_CASE("frames lost by the host make the case inconclusive") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  // Discovery takes a known number of frames; the answer to the case's own upload is the one the host loses.
  bool armed = false;
  device.before = [&](ScriptedDevice&, const can::Frame& frame, BusTime) {
    if (frame.data[1] == 0x17 && frame.data[0] == 0x40 && armed) bus.drop_at_harness(bus.frame_count() + 1);
    if (frame.data[1] == 0x18 && frame.data[3] == 0x01) armed = true;
    return false;
  };
  const auto out = play(bus, device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1018h:01}
      - upload: {object: 1017h:00}
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::inconclusive);
  CHECK(out.only().reason.find("the host lost") != std::string::npos);
}

TEST_CASE("an interface that breaks ends the run as an error with the interface's message") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  bus.break_harness(BusTime(50ms), {"the interface went down", "can0", "sudo ip link set can0 up"});
  const auto out = play(bus, device, three_reads);
  CHECK(out.run.aborted->find("the interface went down") != std::string::npos);
  for (const auto& each : out.run.cases) CHECK(each.verdict != Verdict::fail);
  CHECK(result::exit_code(out.run) == 3);
}

TEST_CASE("a late answer is never taken for the answer to the next request") {
  ScriptedDevice device;
  device.before = [](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    if (frame.data[0] == 0x80) {
      // The client gave up; only now the answer to 1017h comes.
      self.send(can::data_frame(CanId(0x581), {0x4B, 0x17, 0x10, 0, 0x55, 0x55, 0, 0}));
      return true;
    }
    return frame.data[1] == 0x17 && self.nmt.size() == 1;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    steps:
      - upload: {object: 1017h:00}
        checks: T-MUST
      - upload: {object: 1000h:00}
        checks: T-OTHER
        expect: {value: 0000 0191h}
)");
  CHECK(out.verdict_of("T-MUST") == Verdict::fail);
  CHECK(out.verdict_of("T-OTHER") == Verdict::pass);
}

TEST_CASE("a read-only run sends SDO uploads to the device and nothing else") {
  ScriptedDevice device;
  RunOptions options;
  options.plan.allowed = scenario::Risk::read_only;
  const auto out = play(device, change_1017 + three_reads, options);
  for (const auto& captured : out.capture.frames()) {
    if (captured.direction != can::Direction::transmitted) continue;
    CHECK(captured.frame.id == 0x601);
    CHECK(
        (captured.frame.data[0] == 0x40 || captured.frame.data[0] == 0x60 || captured.frame.data[0] == 0x70));
  }
  REQUIRE(out.run.cases.size() == 4);
  CHECK(out.run.cases[3].verdict == Verdict::not_applicable);
  CHECK(out.run.cases[3].reason.find("held back: risk 'config'") == 0);
  CHECK(device.nmt.empty());
  CHECK(result::exit_code(out.run) == 0);
}

TEST_CASE("NMT commands go to the node under test and never to all nodes") {
  ScriptedDevice device;
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: motion
    steps:
      - nmt: start
      - nmt: stop
      - reset: node
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::pass);
  for (const auto& captured : out.capture.frames()) {
    if (captured.frame.id == 0) CHECK(captured.frame.data[1] == 1);
  }
}

TEST_CASE("a stop request ends the run, puts values back and passes nothing unfinished") {
  ScriptedDevice device;
  std::atomic<int> stop{0};
  device.before = [&stop](ScriptedDevice& self, const can::Frame&, BusTime) {
    if (!self.writes.empty()) stop = SIGINT;
    return false;
  };
  RunOptions options;
  options.stop = &stop;
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
        checks: T-MUST
      - upload: {object: 1017h:00}
        checks: T-OTHER
      - upload: {object: 1000h:00}
        checks: T-OTHER
)",
                        options);
  CHECK(out.run.signal == SIGINT);
  CHECK(result::exit_code(out.run) == 130);
  CHECK(out.only().verdict == Verdict::error);
  CHECK_FALSE(out.only().finished);
  CHECK(device.entries.at(0x101700) == std::vector<std::uint8_t>{0, 0});
}

TEST_CASE("a guard request leaves no watch behind on a device that has a life time by itself") {
  const std::string guarded = R"(
  - id: guarded
    title: t
    risk: config
    steps:
      - guard: once
        checks: T-MUST
)";
  const auto resets_with = [&](std::uint8_t guard_time, std::uint8_t factor, const std::string& scenario) {
    ScriptedDevice device;
    device.entries[0x100C00] = {guard_time, 0};
    device.entries[0x100D00] = {factor};
    (void)play(device, scenario + three_reads);
    return std::ranges::count(device.nmt, std::uint8_t{0x82});
  };
  CHECK(resets_with(100, 2, guarded) == 1);
  // Requests that go on over a reset begin the watch again.
  const std::string guarded_over_a_reset = R"(
  - id: guarded
    title: t
    risk: config
    steps:
      - produce: {guard: {every: 5 ms}}
      - nmt: reset communication
      - wait: 100 ms
      - stop: guard
      - upload: {object: 1000h:00}
        checks: T-MUST
)";
  CHECK(resets_with(100, 2, guarded_over_a_reset) == 2);
  CHECK(resets_with(0, 2, guarded) == 0);
  CHECK(resets_with(100, 0, guarded) == 0);
}

TEST_CASE("the same seed gives the same frames at the same times") {
  const auto frames_of = [](std::uint64_t seed) {
    can::SimulatedBus bus(can::SimulatedBus::Options{.seed = seed});
    ScriptedDevice device;
    std::vector<std::pair<Duration::rep, std::uint32_t>> out;
    const auto played = play(bus, device, three_reads + change_1017);
    for (const auto& captured : played.capture.frames()) {
      out.emplace_back(captured.time.time_since_epoch().count(), captured.frame.id);
    }
    return out;
  };
  CHECK(frames_of(7) == frames_of(7));
  CHECK(frames_of(7) != frames_of(8));
}
