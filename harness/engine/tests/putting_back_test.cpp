// SPDX-License-Identifier: Apache-2.0
// In which state, and under which life signs, the values of a device are put back.
#include <optional>

#include "bench.hpp"
#include "engine/recover.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using namespace std::chrono_literals;
using result::Verdict;

TEST_CASE("whom a device watches it hears until it watches no more, however slowly it answers") {
  /// Stops for good where the heartbeat of node 126 or the guard request stays away for 300 ms.
  class Watcher final : public ScriptedDevice {
   public:
    Watcher() {
      entries[0x101601] = {0, 0, 0, 0};
      entries[0x100C00] = {0, 0};
      latency = 250ms;
    }
    void on_frame(const can::Frame& frame, BusTime now) override {
      if (frame.is_data(CanId(0x77E)) || (frame.remote && frame.id == 0x701)) heard_ = now;
      const bool watches = entries[0x101601][0] != 0 || entries[0x100C00][0] != 0;
      missed = missed || (watches && heard_ && now > *heard_ + 300ms);
      if (!missed) ScriptedDevice::on_frame(frame, now);
    }
    bool missed = false;

   private:
    std::optional<BusTime> heard_;
  };
  const std::string watch = GENERATE(R"(
      - download: {object: 1016h:01, value: 007E 012Ch}
        checks: T-MUST
      - produce: {heartbeat: {node: 7Eh, state: operational}}
)",
                                     R"(
      - download: {object: 1016h:01, value: 007E 012Ch}
        checks: T-MUST
      - produce: {heartbeat: {node: 7Eh, state: operational, every: 50 ms}}
      - wait: 400 ms
)",
                                     R"(
      - download: {object: 100Ch:00, value: 300}
        checks: T-MUST
      - guard: {count: 1}
)");
  INFO(watch);
  Watcher device;
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: motion
    steps:)" + watch + R"(
    cleanup:
      - upload: {object: 1000h:00}
)");
  CHECK(out.run.cases.at(0).verdict == Verdict::pass);
  CHECK_FALSE(device.missed);
  CHECK(device.entries[0x101601] == std::vector<std::uint8_t>{0, 0, 0, 0});
  CHECK(device.entries[0x100C00] == std::vector<std::uint8_t>{0, 0});
  CHECK(out.run.notes.empty());
}

TEST_CASE("behind a case that leaves the device in Stopped nothing is asked there") {
  ScriptedDevice device;
  device.entries[0x100C00] = {0x64, 0};
  device.entries[0x100D00] = {3};
  int asked_in_vain = 0;
  device.before = [&](ScriptedDevice& self, const can::Frame&, BusTime) {
    const bool stopped = !self.nmt.empty() && self.nmt.back() == 0x02;
    asked_in_vain += stopped ? 1 : 0;
    return stopped;
  };
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: motion
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
      - guard: {count: 1}
      - nmt: stop
)");
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(asked_in_vain == 0);
}

TEST_CASE("what a restore does to values that nobody wrote is looked at once for each kind of restore") {
  ScriptedDevice device;
  device.entries[0x101100] = {2};
  device.entries[0x101101] = {1, 0, 0, 0};
  device.entries[0x101102] = {1, 0, 0, 0};
  device.entries[0x100600] = {0, 0, 0, 0};
  std::vector<int> looks;  // at 1006h:00, since each reset
  device.on_reset = [&](ScriptedDevice& self) {
    looks.push_back(0);
    // Changes what nobody wrote, each time anew.
    if (self.entries[0x101101][0] != 1) self.entries[0x101400] = {0x80, 0, 0, 0};
    self.entries[0x101101] = self.entries[0x101102] = {1, 0, 0, 0};
  };
  device.before = [&](ScriptedDevice&, const can::Frame& frame, BusTime) {
    const bool looked = frame.data[0] == 0x40 && frame.data[1] == 0x06 && frame.data[2] == 0x10;
    if (looked && !looks.empty()) ++looks.back();
    return false;
  };
  const auto restore = [](const std::string& id, const std::string& sub) {
    return "  - id: " + id +
           "\n    title: t\n    risk: nvm\n    steps:\n      - download: {object: 1011h:" + sub +
           ", value: 6461 6F6Ch}\n        checks: T-MUST\n      - reset: node\n";
  };
  const auto out = play(device, restore("a", "01") + restore("b", "01") + restore("c", "02") + R"(
  - id: d
    title: t
    risk: nvm
    steps:
      - upload: {object: 1014h:00}
        checks: T-MUST
        expect: {value: 81h}
)");
  for (const auto& each : out.run.cases) CHECK(each.verdict == Verdict::pass);
  REQUIRE(looks.size() == 3);
  CHECK(looks[0] == 1);
  CHECK(looks[1] == 0);
  CHECK(looks[2] > 0);  // and once more at the end of the run
}

TEST_CASE("what a run left in one device is not written into another") {
  for (const std::uint64_t vendor : {std::uint64_t{1}, std::uint64_t{2}}) {
    ScriptedDevice device;
    can::SimulatedBus bus;
    bus.attach(device, "device");
    Observer nobody;
    Remains remains;
    remains.changes.push_back({{Index(0x1017), SubIndex(0)}, Bytes{0xE8, 0x03}});
    remains.identity = {{{Index(0x1018), SubIndex(1)}, vendor}};
    const auto done = recover(bus.transport(), device::default_profile(NodeId(1)), remains, nobody);
    CHECK(done.has_value() == (vendor == 1));
    CHECK(device.writes.empty() == (vendor == 2));
    if (!done) CHECK(done.error().text().find("this is another device: 1018h:01") != std::string::npos);
  }
}
