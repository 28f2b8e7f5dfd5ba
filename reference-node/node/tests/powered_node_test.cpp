// SPDX-License-Identifier: Apache-2.0
#include "node/powered_node.hpp"

#include <chrono>
#include <vector>

#include "can/simulated_bus.hpp"
#include "catch.hpp"

using namespace refnode;
using namespace std::chrono_literals;
using conform::can::Direction;
using conform::can::Frame;
using conform::can::SimulatedBus;

namespace {

/// Frames the node has sent within `time`.
std::vector<Frame> heard(SimulatedBus& bus, conform::Duration time) {
  std::vector<Frame> out;
  const auto until = bus.now() + time;
  for (;;) {
    const auto event = bus.transport().receive(until);
    REQUIRE(event.has_value());
    if (!*event) return out;
    if ((*event)->direction == Direction::received) out.push_back((*event)->frame);
  }
}

Frame ask(SimulatedBus& bus, std::initializer_list<std::uint8_t> request) {
  REQUIRE(bus.transport().send(conform::can::data_frame(conform::CanId(0x605), request)).has_value());
  const auto answers = heard(bus, 20ms);
  REQUIRE(answers.size() == 1);
  return answers.front();
}

std::unique_ptr<PoweredNode> node_5(std::vector<std::string> defects = {}) {
  auto node = PoweredNode::create({.node_id = 5, .defects = std::move(defects)});
  REQUIRE(node.has_value());
  return std::move(*node);
}

std::uint8_t heartbeat_time(SimulatedBus& bus) { return ask(bus, {0x40, 0x17, 0x10, 0, 0, 0, 0, 0}).data[4]; }

void set_heartbeat_time(SimulatedBus& bus, std::uint8_t time) {
  CHECK(ask(bus, {0x2B, 0x17, 0x10, 0, time, 0, 0, 0}).data[0] == 0x60);
}

}  // namespace

TEST_CASE("Without power what was not stored is lost, and the node boots up once more") {
  SimulatedBus bus;
  const auto node = node_5();
  bus.attach(*node);
  CHECK(heard(bus, 100ms).size() == 1);
  set_heartbeat_time(bus, 0xC8);
  CHECK(ask(bus, {0x23, 0x10, 0x10, 1, 's', 'a', 'v', 'e'}).data[0] == 0x60);
  set_heartbeat_time(bus, 0);
  bus.unplug(*node);
  CHECK(heard(bus, 100ms).empty());
  bus.attach(*node);
  CHECK(heard(bus, 500ms).empty());
  const auto started = heard(bus, 200ms);
  REQUIRE(started.size() == 1);
  CHECK(started.front().id == 0x705);
  CHECK(heartbeat_time(bus) == 0xC8);
}

TEST_CASE("The switch works while the node runs") {
  SimulatedBus bus;
  const auto node = node_5();
  bus.attach(*node);
  heard(bus, 100ms);
  set_heartbeat_time(bus, 0xC8);
  node->switch_power();
  const auto started = heard(bus, 1100ms);
  REQUIRE(started.size() == 1);
  CHECK(started.front().data[0] == 0);
  CHECK(heartbeat_time(bus) == 0);
}

TEST_CASE("What is only in the working memory is gone with the power") {
  SimulatedBus bus;
  const auto node = node_5({"1010-saved-in-ram"});
  bus.attach(*node);
  heard(bus, 100ms);
  set_heartbeat_time(bus, 0xC8);
  CHECK(ask(bus, {0x23, 0x10, 0x10, 1, 's', 'a', 'v', 'e'}).data[0] == 0x60);
  REQUIRE(bus.transport().send(conform::can::data_frame(conform::CanId(0), {0x81, 5})).has_value());
  heard(bus, 50ms);
  CHECK(heartbeat_time(bus) == 0xC8);
  node->switch_power();
  heard(bus, 1100ms);
  CHECK(heartbeat_time(bus) == 0);
}
