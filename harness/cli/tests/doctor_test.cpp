// SPDX-License-Identifier: Apache-2.0
// What `doctor` makes of what it hears.
#include <linux/can/error.h>

#include <atomic>

#include "can/simulated_bus.hpp"
#include "catch.hpp"
#include "cli/doctor/diagnosis.hpp"
#include "node/node.hpp"

using namespace conform;
using namespace conform::cli;
using namespace std::chrono_literals;

namespace {

/// A frame each 10 ms.
Heard heard(const std::vector<can::Frame>& frames) {
  Heard out;
  BusTime time{};
  for (const auto& frame : frames) note(out, {.frame = frame, .time = time += 10ms});
  out.listened = 2s;
  return out;
}

can::Frame error_frame(std::uint32_t classes) {
  can::Frame out;
  out.id = classes;
  out.error = true;
  out.dlc = 8;
  return out;
}

can::InterfaceFacts can0() {
  can::InterfaceFacts out;
  out.name = "can0";
  out.driver = "kvaser_pci";
  out.up = out.echo = true;
  out.bit_rate = 500000;
  out.sample_point = 875;
  out.queue_length = 1000;
  out.state = "error-active";
  return out;
}

std::string texts(const std::vector<Advice>& advice) {
  std::string out;
  for (const auto& each : advice) out += each.text + " | " + each.hint + "\n";
  return out;
}

}  // namespace

TEST_CASE("nodes are known by what only they send") {
  const auto out = heard({can::data_frame(CanId(0x705), {0x00}), can::data_frame(CanId(0x705), {0x7F}),
                          can::data_frame(CanId(0x705), {0x7F}),
                          can::data_frame(CanId(0x087), {0, 0x10, 1, 0, 0, 0, 0, 0}),
                          can::data_frame(CanId(0x1A1), {1}), can::data_frame(CanId(0x709), {0x85})});
  const auto lines = node_lines(out);
  REQUIRE(lines.size() == 4);
  CHECK(lines[0] == "node 5    boot-up message; heartbeat each 10 ms, pre-operational");
  CHECK(lines[1] == "node 7    EMCY");
  CHECK(lines[2] == "node 9    operational");
  CHECK(lines[3] == "node 33   PDOs");
}

TEST_CASE("a master on the bus is told by what it sends, and the bus can be used all the same") {
  const auto out = heard({can::data_frame(CanId(0x000), {1, 0}),
                          can::data_frame(CanId(0x605), {0x40, 0, 0x10, 0, 0, 0, 0, 0}),
                          can::data_frame(CanId(0x080), {}), can::remote_frame(CanId(0x705), 1)});
  const auto advice = about_bus(can0(), out, false);
  CHECK(is_usable(advice));
  CHECK(texts(advice).contains("NMT commands (1), SDO requests (1), guard requests (1)"));
  CHECK(out.nodes.empty());
}

TEST_CASE("a wrong bit rate is told by destroyed frames without a right one") {
  const auto advice = about_bus(
      can0(), heard({error_frame(CAN_ERR_PROT | CAN_ERR_BUSERROR), error_frame(CAN_ERR_PROT)}), false);
  CHECK_FALSE(is_usable(advice));
  CHECK(texts(advice).contains("2 frames were destroyed and none was right"));
  CHECK(texts(advice).contains("ip link set can0 up type can bitrate"));
}

TEST_CASE("who sends alone is told so, and a bus-off what to do") {
  CHECK(texts(about_bus(can0(), heard({error_frame(CAN_ERR_ACK)}), true)).contains("nobody acknowledges"));
  const auto off = about_bus(can0(), heard({error_frame(CAN_ERR_BUSOFF)}), false);
  CHECK(texts(off).contains("sudo ip link set can0 type can restart"));
  CHECK_FALSE(is_usable(off));
}

TEST_CASE("a silent bus is no fault until somebody was asked") {
  CHECK(is_usable(about_bus(can0(), heard({}), false)));
  CHECK(texts(about_bus(can0(), heard({}), false)).contains("--ask"));
  CHECK_FALSE(is_usable(about_bus(can0(), heard({}), true)));
}

TEST_CASE("an interface says what may spoil a run") {
  CHECK(texts(about_interface(can0())).starts_with("up, 500 kbit/s, sample point 87.5 %, driver kvaser_pci"));
  auto facts = can0();
  facts.queue_length = 10;
  facts.state = "error-passive";
  facts.echo = false;
  const auto said = texts(about_interface(facts));
  CHECK(said.contains("sudo ip link set can0 txqueuelen 1000"));
  CHECK(said.contains("error-passive"));
  CHECK(said.contains("before they were on the bus"));
}

TEST_CASE("everybody is asked, and who answers is there") {
  can::SimulatedBus bus;
  auto node = refnode::Node::create({.node_id = 42});
  REQUIRE(node.has_value());
  bus.attach(**node, "reference node");
  Heard out;
  const std::atomic<int> stop{0};
  REQUIRE(listen(bus.transport(), 1s, stop, out));
  REQUIRE(ask_everybody(bus.transport(), 20ms, stop, out));
  REQUIRE(out.nodes.size() == 1);
  CHECK(out.nodes.at(42).device_type == 0x000F0191);
  CHECK(out.nodes.at(42).boot_ups == 1);
  CHECK(out.sdo_requests == 0);  // our own are none of a master
}
