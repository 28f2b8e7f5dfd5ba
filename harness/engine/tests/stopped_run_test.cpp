// SPDX-License-Identifier: Apache-2.0
// Values are put back, also when somebody stops the run in the middle.
#include <csignal>

#include "bench.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using result::Verdict;

TEST_CASE("a stop request in the middle of restoring waits until the values are back") {
  ScriptedDevice device;
  std::atomic<int> stop{0};
  bool changed = false;
  device.before = [&](ScriptedDevice& self, const can::Frame& frame, BusTime) {
    // The first look of the restore at the changed entry.
    if (changed && frame.data[0] == 0x40 && frame.data[1] == 0x17) stop = SIGINT;
    if (!self.writes.empty()) changed = true;
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
      - upload: {object: 1000h:00}
        checks: T-MUST
)",
                        options);
  CHECK(stop == SIGINT);
  CHECK(device.entries.at(0x101700) == std::vector<std::uint8_t>{0, 0});
  CHECK(out.run.signal == SIGINT);
}

TEST_CASE("a run stopped while a reset brings back what a test wrote puts it back all the same") {
  ScriptedDevice device;
  std::atomic<int> stop{0};
  // Stores by itself.
  device.on_reset = [&stop](ScriptedDevice& self) {
    if (self.writes.empty()) return;
    self.entries[0x101700] = {0xE8, 0x03};
    stop = SIGINT;
  };
  auto options = RunOptions{};
  options.stop = &stop;
  can::SimulatedBus bus;
  const auto out = play(bus, device, change_1017 + R"(
  - id: next
    title: t
    risk: config
    fresh: node
    steps:
      - upload: {object: 1017h:00}
        checks: T-MUST
)",
                        options);
  REQUIRE(out.run.cases.size() == 2);
  CHECK(out.run.cases[0].verdict == Verdict::pass);
  CHECK(out.run.cases[1].verdict == Verdict::error);
  CHECK(out.run.aborted == "stopped by the user");
  CHECK(device.entries.at(0x101700) == std::vector<std::uint8_t>{0, 0});
}

TEST_CASE("a run stopped while the device is in Stopped puts values back all the same") {
  ScriptedDevice device;
  std::atomic<int> stop{0};
  device.before = [&stop](ScriptedDevice& self, const can::Frame&, BusTime) {
    if (self.nmt.empty() || self.nmt.back() != 0x02) return false;
    stop = SIGINT;
    return true;
  };
  RunOptions options;
  options.stop = &stop;
  (void)play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 1017h:00, value: 1000}
      - nmt: stop
      - upload: {object: 1000h:00}
        checks: T-MUST
        expect: silence
)",
             options);
  CHECK(device.entries.at(0x101700) == std::vector<std::uint8_t>{0, 0});
}

TEST_CASE("a stopped case is cleaned up, because only the scenario knows what it stored") {
  ScriptedDevice device;
  std::atomic<int> stop{0};
  device.entries[0x101000] = {1};
  device.entries[0x101001] = {1, 0, 0, 0};
  device.before = [&stop](ScriptedDevice& self, const can::Frame&, BusTime) {
    if (!self.writes.empty()) stop = SIGTERM;
    return false;
  };
  RunOptions options;
  options.stop = &stop;
  (void)play(device, R"(
  - id: a
    title: t
    risk: nvm
    steps:
      - download: {object: 1010h:01, value: 6576 6173h}
        checks: T-MUST
      - upload: {object: 1000h:00}
        checks: T-OTHER
    cleanup:
      - download: {object: 1010h:01, value: 1234 5678h}
)",
             options);
  CHECK(device.writes == std::vector<std::string>{"1010h = 73 61 76 65", "1010h = 78 56 34 12"});
}

TEST_CASE("an entry that no description names is put back as well") {
  ScriptedDevice device;
  device.entries[0x200000] = {7};
  const auto out = play(device, R"(
  - id: a
    title: t
    risk: config
    steps:
      - download: {object: 2000h:00, bytes: "09"}
        checks: T-MUST
)");
  CHECK(out.only().verdict == Verdict::pass);
  CHECK(device.entries.at(0x200000) == std::vector<std::uint8_t>{7});
}
