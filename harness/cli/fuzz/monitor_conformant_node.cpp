// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: whatever a client does to the reference node, in whatever legal variant, no monitor may
// find anything. The node is right by definition: a finding is a mistake of the monitor, or of the node.
//
// A client may do everything but one thing: go on asking a server that is slow by choice. Then nobody can
// tell from the trace which answer is whose.
//
// Input: bit_rate (& 3) seed variant variant, then the program of reference-node/fuzz/client_program.hpp. A
// variant is the number of its row, from 1, or 0; a second one that does not go with the first is left out.
// So the seeds of the target `node` are seeds here, too.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/text.hpp"
#include "can/frame_time.hpp"
#include "can/simulated_bus.hpp"
#include "canopen/decode.hpp"
#include "fuzz/client_program.hpp"
#include "monitor/watch.hpp"
#include "node/node.hpp"
#include "variants/variant.hpp"

namespace {

using namespace conform;
using namespace std::chrono_literals;
using fuzz::Input;

struct Setting {
  can::SimulatedBus::Options bus;
  refnode::Options node;
  Duration patience{};  ///< with which the client waits for an answer
};

Setting setting_of(Input& input) {
  constexpr std::uint32_t rates[] = {1'000'000, 500'000, 250'000, 125'000};
  Setting out;
  out.bus.bit_rate = rates[input.u8() & 3U];
  out.bus.seed = input.u8();
  out.node.node_id = refnode::fuzz::node_id;
  const auto rows = refnode::variants();
  std::vector<const refnode::Variant*> chosen;
  for (int count = 0; count < 2; ++count) {
    const std::size_t number = input.u8() % (rows.size() + 1);
    if (number == 0) continue;
    const auto& row = rows[number - 1];
    const bool fits = std::ranges::all_of(chosen, [&](const auto* other) { return compatible(row, *other); });
    // What the catalogue warns of is tolerated, but a monitor may tell it.
    if (fits && row.warns.empty()) chosen.push_back(&row);
  }
  for (const auto* row : chosen) {
    out.node.variants.emplace_back(row->id);
    if (row->group == "turnaround") out.patience = std::max<Duration>(out.patience, 300ms);
    if (row->group == "storing") out.patience = 10s;
  }
  return out;
}

class Scene {
 public:
  explicit Scene(const Setting& setting) : bus_(setting.bus), variants_(join(setting.node.variants, ", ")) {
    auto node = refnode::Node::create(setting.node);
    CONFORM_CHECK(node.has_value());
    node_ = std::move(*node);
    monitor::Facts facts;
    facts.node = NodeId(refnode::fuzz::node_id);
    facts.alone = true;
    std::vector<const monitor::Rule*> chosen;
    for (const auto& rule : monitor::rules()) chosen.push_back(&rule);
    watch_ = std::make_unique<monitor::Watch>(facts, chosen);
    bus_.attach(*node_);
  }

  void send(const can::Frame& frame) { CONFORM_CHECK(bus_.transport().send(frame).has_value()); }

  /// False: the bus is overloaded, by cyclic frames or a flood of requests. What waits too long in the node's
  /// queue says nothing about the node.
  [[nodiscard]] bool pass(Duration duration) {
    const BusTime end = bus_.now() + duration;
    while (true) {
      const auto event = bus_.transport().receive(end);
      CONFORM_CHECK(event.has_value());  // else the node keeps the simulation from going on
      if (!*event) return true;
      const auto rate = bus_.transport().info().bit_rate;
      const BusTime start = (*event)->time - can::bit_time(can::frame_bits((*event)->frame), rate);
      if (start > last_end_ + can::bit_time(6, rate)) busy_since_ = start;
      last_end_ = (*event)->time;
      if (last_end_ - busy_since_ > 50ms) return false;
      frames_.push_back({(*event)->frame, (*event)->time, (*event)->direction, {}});
      watch_->on_frame(frames_.back(), frames_.size() - 1);
      if ((*event)->direction == can::Direction::received && (*event)->frame.id >> 7U == 0xBU) ++answers_;
    }
  }

  [[nodiscard]] bool wait_for_answer(Duration limit) {
    const auto before = answers_;
    for (const BusTime end = bus_.now() + limit; bus_.now() < end && answers_ == before;) {
      if (!pass(5ms)) return false;
    }
    return true;
  }

  void must_be_right() {
    watch_->end();
    CONFORM_CHECK(bus_.queue_overruns(*node_) == 0);
    bool right = true;
    for (const auto& monitor : watch_->monitors()) {
      for (const auto& violation : monitor->violations()) {
        right = false;
        tell(*monitor, violation);
      }
    }
    if (!right) std::abort();
  }

 private:
  void tell(const monitor::Monitor& monitor, const monitor::Violation& violation) const {
    std::string text = fmt::format("{}: {}, expected {}, came {} ({}); variants: {}\n",
                                   monitor.rule().requirements[violation.requirement], monitor.rule().name,
                                   violation.expected, violation.actual, violation.reason, variants_);
    canopen::Decoder decoder{NodeId(refnode::fuzz::node_id)};
    for (std::size_t i = 0; i <= violation.index; ++i) {
      const auto& each = frames_[i];
      const auto meaning = decoder.meaning(each.frame, each.direction);
      if (i + 40 < violation.index) continue;
      text += fmt::format("{:>12} {} {:03X}{}  {}  {}\n", to_string(each.time.time_since_epoch()),
                          each.direction == can::Direction::received ? '<' : '>', each.frame.id,
                          each.frame.remote ? "R" : "", hex_bytes(each.frame.bytes()), meaning);
    }
    std::fputs(text.c_str(), stderr);
  }

  can::SimulatedBus bus_;
  BusTime busy_since_{}, last_end_{};
  std::size_t answers_ = 0;
  std::string variants_;
  std::unique_ptr<refnode::Node> node_;
  std::unique_ptr<monitor::Watch> watch_;
  std::vector<can::CapturedFrame> frames_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const auto setting = setting_of(input);
  Scene scene(setting);
  bool free = scene.pass(60ms);
  refnode::fuzz::ClientProgram program(input);
  while (free) {
    const auto action = program.next();
    if (!action) break;
    if (action->frame) scene.send(*action->frame);
    if (action->frame && setting.patience > Duration{}) free = scene.wait_for_answer(setting.patience);
    if (free && action->pause > Duration{}) free = scene.pass(action->pause);
  }
  if (free) (void)scene.pass(2s);
  scene.must_be_right();
  return 0;
}
