// SPDX-License-Identifier: Apache-2.0
// Block transfer on the simulated bus: how full the wire is, and that the client still gets a word in.
#include "can/frame_time.hpp"
#include "can/simulated_bus.hpp"
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;
using conform::can::BusEvent;
using conform::can::Direction;

namespace {

struct Wire {
  explicit Wire(std::uint32_t bit_rate) : bus({.bit_rate = bit_rate}) {
    Options options;
    options.node_id = 5;
    auto made = Node::create(options);
    REQUIRE(made.has_value());
    node = std::move(*made);
    bus.attach(*node, "node");
    while (next(100ms)) {
    }
  }
  void send(std::uint32_t id, std::string_view bytes) {
    const auto data = conform::parse_bytes(bytes);
    REQUIRE(data.has_value());
    REQUIRE(bus.transport().send(conform::can::data_frame(conform::CanId(id), *data)).has_value());
  }
  std::optional<BusEvent> next(conform::Duration patience) {
    const auto event = bus.transport().receive(bus.now() + patience);
    REQUIRE(event.has_value());
    if (*event) busy_bits += conform::can::frame_bits((*event)->frame) + conform::can::intermission_bits;
    return *event;
  }
  /// Frames of the node until it is silent.
  std::size_t count_answers() {
    std::size_t count = 0;
    while (const auto event = next(50ms)) count += event->direction == Direction::received ? 1 : 0;
    return count;
  }

  conform::can::SimulatedBus bus;
  std::unique_ptr<Node> node;
  std::uint64_t busy_bits = 0;
};

}  // namespace

TEST_CASE("A block upload leaves hardly a bit time of the bus unused") {
  for (const std::uint32_t bit_rate : {125'000U, 1'000'000U}) {
    Wire wire(bit_rate);
    wire.send(0x605, "A4 00 20 0F 7F 00 00 00");  // 256 bytes
    REQUIRE(wire.next(10ms));
    REQUIRE(wire.next(10ms));
    const auto begin = wire.bus.now();
    wire.busy_bits = 0;
    wire.send(0x605, "A3 00 00 00 00 00 00 00");
    for (int frame = 0; frame < 38; ++frame) REQUIRE(wire.next(10ms));
    const auto used = conform::can::bit_time(wire.busy_bits, bit_rate);
    const auto taken = wire.bus.now() - begin;
    CHECK(used.count() * 100 >= taken.count() * 95);
  }
}

TEST_CASE("A client abort gets on the bus between two segments and stops the sub-block") {
  for (const std::uint32_t bit_rate : {10'000U, 125'000U, 1'000'000U}) {
    Wire wire(bit_rate);
    wire.send(0x605, "A0 00 20 0F 7F 00 00 00");
    wire.count_answers();
    wire.send(0x605, "A3 00 00 00 00 00 00 00");
    for (int frame = 0; frame < 4; ++frame) REQUIRE(wire.next(50ms));
    wire.send(0x605, "80 00 20 0F 00 00 00 08");
    CHECK(wire.count_answers() <= 8);
    wire.send(0x605, "40 00 10 00 00 00 00 00");
    CHECK(wire.count_answers() == 1);
  }
}

TEST_CASE("Stopping the node stops a sub-block") {
  Wire wire(125'000);
  wire.send(0x605, "A0 00 20 0F 7F 00 00 00");
  wire.count_answers();
  wire.send(0x605, "A3 00 00 00 00 00 00 00");
  for (int frame = 0; frame < 4; ++frame) REQUIRE(wire.next(50ms));
  wire.send(0x000, "02 05");
  CHECK(wire.count_answers() <= 3);  // what is on the wire or in the transmit queue already
}

TEST_CASE("Frames lost by a full transmit queue do not stop block transfer for ever") {
  Options options;
  options.node_id = 5;
  auto made = Node::create(options);
  REQUIRE(made.has_value());
  int sent = 0;
  (*made)->attach([&](const conform::can::Frame&) { ++sent; }, conform::BusTime{});
  conform::BusTime now{100ms};
  (*made)->on_time(now);
  const auto request = [&](std::initializer_list<std::uint8_t> bytes) {
    (*made)->on_frame(conform::can::data_frame(conform::CanId(0x605), bytes), now);
  };
  request({0xA0, 0x08, 0x10, 0x00, 0x7F, 0, 0, 0});
  request({0xA3, 0, 0, 0, 0, 0, 0, 0});
  CHECK(sent == 2);  // nothing was ever confirmed: the queue counts as full
  for (int i = 0; i < 10 && sent < 5; ++i) {
    REQUIRE((*made)->next_wakeup().has_value());
    now = *(*made)->next_wakeup();
    (*made)->on_time(now);
  }
  CHECK(sent == 5);
}
