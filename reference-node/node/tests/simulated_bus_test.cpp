// SPDX-License-Identifier: Apache-2.0
// The node on the simulated bus, beside a second one that it watches.
#include "can/simulated_bus.hpp"
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

TEST_CASE("Two nodes live on the simulated bus and one notices that the other has gone") {
  auto watcher = Node::create({5, {}, {}, {}});
  auto watched = Node::create({6, {}, {}, {}});
  REQUIRE((watcher.has_value() && watched.has_value()));
  conform::can::SimulatedBus bus;
  bus.attach(**watcher, "watcher");
  bus.attach(**watched, "watched");
  auto& transport = bus.transport();
  std::vector<std::string> heard;
  const auto listen = [&](conform::Duration duration) {
    heard.clear();
    const auto end = transport.now() + duration;
    for (;;) {
      const auto event = transport.receive(end);
      REQUIRE(event.has_value());
      if (!*event) break;
      if ((*event)->direction == conform::can::Direction::transmitted) continue;
      heard.push_back(conform::hex((*event)->frame.id, 3) + " " +
                      conform::hex_bytes((*event)->frame.bytes()));
    }
  };
  const auto request = [&](std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
    REQUIRE(transport.send(conform::can::data_frame(conform::CanId(id), bytes)).has_value());
    listen(5ms);
  };

  listen(100ms);
  CHECK(heard == Frames{"705h 00", "706h 00"});
  request(0x605, {0x23, 0x16, 0x10, 0x01, 0xC8, 0x00, 0x06, 0x00});
  CHECK(heard == Frames{"585h 60 16 10 01 00 00 00 00"});
  request(0x606, {0x2B, 0x17, 0x10, 0x00, 0x64, 0x00, 0x00, 0x00});
  CHECK(heard == Frames{"586h 60 17 10 00 00 00 00 00"});
  listen(250ms);
  CHECK(heard == Frames{"706h 7F", "706h 7F"});
  bus.unplug(**watched);
  listen(1s);
  CHECK(heard == Frames{"085h 30 81 11 06 01 00 00 00"});
}
