// SPDX-License-Identifier: Apache-2.0
#include "engine/lss_survey.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include "can/simulated_bus.hpp"
#include "catch.hpp"
#include "node/node.hpp"
#include "parts/parts.hpp"

using namespace conform;
using namespace std::chrono_literals;

namespace {

struct Network {
  explicit Network(const std::vector<std::uint32_t>& serials, std::uint8_t node_id = 255) {
    for (const auto serial : serials) {
      auto node = refnode::Node::create({.node_id = node_id, .adjust = [serial](refnode::Parts& parts) {
                                           parts.device.dictionary.set_number(0x1018, 4, serial);
                                         }});
      REQUIRE(node.has_value());
      nodes.push_back(std::move(*node));
      bus.attach(*nodes.back());
    }
    REQUIRE(recorder.wait_until(recorder.now() + 100ms).has_value());
  }

  std::vector<std::uint32_t> scan() {
    const auto found = engine::find_unconfigured(recorder, {.timeout = 20ms});
    REQUIRE(found.has_value());
    std::vector<std::uint32_t> serials;
    for (const auto& address : *found) {
      CHECK(address[0] == 0x5AFE);
      serials.push_back(address[3]);
    }
    std::ranges::sort(serials);
    return serials;
  }

  can::SimulatedBus bus;
  std::vector<std::unique_ptr<refnode::Node>> nodes;
  engine::Recorder recorder{bus.transport(), nullptr};
};

}  // namespace

TEST_CASE("A fastscan finds 1 of 1 slaves without node-ID") {
  Network network({0x1234'5678});
  CHECK(network.scan() == std::vector<std::uint32_t>{0x1234'5678});
}

TEST_CASE("A fastscan finds 5 of 5 slaves without node-ID, and again when it is repeated") {
  const std::vector<std::uint32_t> serials = {0, 1, 3, 0x8000'0001, 0xFFFF'FFFF};
  Network network(serials);
  CHECK(network.scan() == serials);
  CHECK(network.scan() == serials);
}

TEST_CASE("A fastscan finds nobody where every slave has its node-ID, or none is there") {
  Network configured({7}, 5);
  CHECK(configured.scan().empty());
  Network nobody({});
  CHECK(nobody.scan().empty());
}

TEST_CASE("What was found gets a node-ID each, boots up with it and is not found again") {
  Network network({1, 2, 3});
  const auto found = engine::find_unconfigured(network.recorder, {.timeout = 20ms});
  REQUIRE(found.has_value());
  REQUIRE(found->size() == 3);
  std::uint8_t node = 10;
  const auto from = network.recorder.capture().size();
  for (const auto& address : *found)
    REQUIRE(engine::give_node_id(network.recorder, address, NodeId(node++), 20ms).has_value());
  REQUIRE(network.recorder.wait_until(network.recorder.now() + 100ms).has_value());
  std::vector<std::uint32_t> started;
  const auto& frames = network.recorder.capture().frames();
  for (auto i = from; i < frames.size(); ++i) {
    if (frames[i].frame.id > 0x700 && frames[i].frame.id < 0x780) started.push_back(frames[i].frame.id);
  }
  CHECK(started == std::vector<std::uint32_t>{0x70A, 0x70B, 0x70C});
  CHECK(network.scan().empty());
}

TEST_CASE("Of many slaves no more are looked for than are wanted") {
  Network network({1, 2, 3});
  const auto found = engine::find_unconfigured(network.recorder, {.timeout = 20ms, .most = 2});
  REQUIRE(found.has_value());
  CHECK(found->size() == 2);
}
