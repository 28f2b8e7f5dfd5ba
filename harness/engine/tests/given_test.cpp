// SPDX-License-Identifier: Apache-2.0
// What a case works with and whom it concerns: conditions that listen to the bus, entries that are looked
// for.
#include "bench.hpp"

using namespace conform;
using namespace conform::engine;
using namespace conform::engine::testing;
using namespace std::chrono_literals;
using result::Verdict;

namespace {

/// Sends one frame, some time after the beginning.
class Talker final : public can::Participant {
 public:
  Talker(can::Frame frame, Duration after) : frame_(frame), after_(after) {}
  void attach(Sender sender, BusTime now) override {
    sender_ = std::move(sender);
    due_ = now + after_;
  }
  void on_frame(const can::Frame&, BusTime) override {}
  void on_time(BusTime) override {
    if (due_) sender_(frame_);
    due_.reset();
  }
  [[nodiscard]] std::optional<BusTime> next_wakeup() const override { return due_; }

 private:
  can::Frame frame_;
  Duration after_;
  Sender sender_;
  std::optional<BusTime> due_;
};

const std::string when_alone = R"(
  - id: a
    title: t
    when: nobody else is heard on the bus
    steps:
      - upload: {object: 1000h:00}
        checks: T-MUST
)";

Verdict verdict_beside(const can::Frame& frame, Duration after) {
  can::SimulatedBus bus;
  ScriptedDevice device;
  Talker talker(frame, after);
  bus.attach(talker, "talker");
  return play(bus, device, when_alone).only().verdict;
}

}  // namespace

TEST_CASE("Nobody else is heard as long as only the device sends, on CAN-IDs that are its own") {
  ScriptedDevice device;
  CHECK(play(device, when_alone).only().verdict == Verdict::pass);
  // By its node-ID, and by what its entries hold.
  CHECK(verdict_beside(can::data_frame(CanId(0x181), {1}), 10ms) == Verdict::pass);
  CHECK(verdict_beside(can::data_frame(CanId(0x701), {5}), 10ms) == Verdict::pass);
}

TEST_CASE("Somebody who is heard within the first seconds makes the device one of several") {
  CHECK(verdict_beside(can::data_frame(CanId(0x707), {5}), 10ms) == Verdict::not_applicable);
  CHECK(verdict_beside(can::data_frame(CanId(0x707), {5}), 4s) == Verdict::not_applicable);
  CHECK(verdict_beside(can::data_frame(CanId(0x607), {0x40, 0, 0x10, 0, 0, 0, 0, 0}), 4s) ==
        Verdict::not_applicable);
  CHECK(verdict_beside(can::data_frame(CanId(0x000), {1, 7}), 4s) == Verdict::not_applicable);
}

TEST_CASE("A CAN-ID that the device holds in a valid COB-ID is its own") {
  can::SimulatedBus bus;
  ScriptedDevice device;
  device.entries[0x180000] = {2};
  device.entries[0x180001] = {0x34, 0x02, 0, 0};
  device.entries[0x180101] = {0x35, 0x02, 0, 0x80};
  SECTION("valid") {
    Talker talker(can::data_frame(CanId(0x234), {1}), 10ms);
    bus.attach(talker, "talker");
    CHECK(play(bus, device, when_alone).only().verdict == Verdict::pass);
  }
  SECTION("not valid") {
    Talker talker(can::data_frame(CanId(0x235), {1}), 10ms);
    bus.attach(talker, "talker");
    CHECK(play(bus, device, when_alone).only().verdict == Verdict::not_applicable);
  }
}
