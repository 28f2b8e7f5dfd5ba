// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: whatever a device description says, its twin starts, holds values as long as their types,
// serves every entry, sends nothing but frames of a device, and never hangs.
//
// Input: the file. Seeds: the fixtures of the reader of device descriptions.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "base/check.hpp"
#include "eds/eds.hpp"
#include "eds/read.hpp"
#include "node/node.hpp"

namespace {

using namespace refnode;
using namespace std::chrono_literals;
using conform::BusTime;
using conform::CanId;
using conform::can::Frame;

constexpr std::uint8_t node_id = 5;
constexpr std::size_t most_entries = 300;  // of a large file; more of the same shows nothing new

class World {
 public:
  explicit World(std::unique_ptr<Node> node) : node_(std::move(node)) {
    node_->attach([this](const Frame& frame) { on_sent(frame); }, now_);
    pass(50ms);
  }

  void send(std::uint32_t id, const std::vector<std::uint8_t>& data) {
    node_->on_frame(conform::can::data_frame(CanId(id), data), now_);
    confirm();
  }

  void pass(conform::Duration duration) {
    const BusTime end = now_ + duration;
    int at_once = 0;
    while (const auto next = node_->next_wakeup()) {
      if (*next > end) break;
      CONFORM_CHECK(*next <= now_ ? ++at_once < 5000 : true);  // time would stand still
      if (*next > now_) at_once = 0;
      now_ = std::max(now_, *next);
      node_->on_time(now_);
      confirm();
    }
    now_ = end;
  }

  /// One upload and one download, answered each.
  void use(std::uint16_t index, std::uint8_t sub) {
    const auto low = static_cast<std::uint8_t>(index & 0xFFU);
    const auto high = static_cast<std::uint8_t>(index >> 8U);
    for (const std::uint8_t command : {std::uint8_t{0x40}, std::uint8_t{0x23}, std::uint8_t{0x2F}}) {
      answers_ = 0;
      send(0x600U + node_id, {command, low, high, sub, 1, 0, 0, 0});
      CONFORM_CHECK(answers_ >= 1);  // a TPDO may have been given the same CAN-ID
      send(0x600U + node_id, {0x80, low, high, sub, 0, 0, 0, 8});
    }
  }

 private:
  void confirm() {
    for (; waiting_ > 0; --waiting_) node_->on_transmitted(now_);
  }
  void on_sent(const Frame& frame) {
    ++waiting_;
    CONFORM_CHECK(!frame.extended && !frame.error && !frame.remote && frame.id <= 0x7FF && frame.dlc <= 8);
    CONFORM_CHECK(frame.id != 0);  // a twin commands nobody
    if (frame.id == 0x580U + node_id) ++answers_;
  }

  std::unique_ptr<Node> node_;
  BusTime now_{};
  std::size_t waiting_ = 0, answers_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto file = conform::eds::read({reinterpret_cast<const char*>(data), size}, "fuzz.eds");
  if (!file) return 0;
  Options options;
  options.node_id = node_id;
  options.description = std::make_shared<const conform::eds::EdsFile>(std::move(*file));
  auto node = Node::create(std::move(options));
  if (!node) return 0;
  std::vector<std::pair<std::uint16_t, std::uint8_t>> entries;
  for (const auto& [index, object] : (*node)->dictionary().objects()) {
    for (const auto& [sub, entry] : object.entries) {
      const std::size_t fixed = fixed_size(entry.type);
      CONFORM_CHECK(fixed != 0 ? entry.value.size() == fixed : entry.value.size() <= entry.max_size);
      CONFORM_CHECK(entry.value == entry.default_value);
      if (entries.size() < most_entries) entries.emplace_back(index, sub);
    }
  }
  World world(std::move(*node));
  world.send(0x000, {0x01, node_id});
  world.pass(20ms);
  for (const std::uint32_t id : {0x80U, 0x100U, 0x205U, 0x305U, 0x405U, 0x709U}) {
    world.send(id, {});
    world.send(id, {1});
    world.send(id, {1, 2, 3, 4, 5, 6, 7, 8});
  }
  world.send(0x000, {0x80, node_id});
  for (const auto& [index, sub] : entries) world.use(index, sub);
  world.send(0x000, {0x01, node_id});
  world.pass(50ms);
  world.send(0x000, {0x81, node_id});
  world.pass(50ms);
  return 0;
}
