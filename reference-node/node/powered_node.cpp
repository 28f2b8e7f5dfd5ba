// SPDX-License-Identifier: Apache-2.0
#include "node/powered_node.hpp"

#include <utility>

#include "base/check.hpp"

namespace refnode {

conform::Result<std::unique_ptr<PoweredNode>> PoweredNode::create(Options options) {
  if (!options.storage) options.storage = std::make_shared<MemoryStorage>();
  auto node = Node::create(options);
  if (!node) return std::unexpected(node.error());
  return std::unique_ptr<PoweredNode>(new PoweredNode(std::move(options), std::move(*node)));
}

void PoweredNode::attach(Sender sender, conform::BusTime now) {
  sender_ = std::move(sender);
  start(now);
}

void PoweredNode::start(conform::BusTime now) {
  if (was_on_) {
    auto node = Node::create(options_);
    CONFORM_CHECK(node.has_value());  // it could be made of the same options before
    node_ = std::move(*node);
  }
  was_on_ = true;
  node_->attach(sender_, now);
}

void PoweredNode::on_frame(const conform::can::Frame& frame, conform::BusTime now) {
  node_->on_frame(frame, now);
}

void PoweredNode::on_transmitted(conform::BusTime now) { node_->on_transmitted(now); }

void PoweredNode::on_time(conform::BusTime now) {
  if (switch_wanted_.exchange(false, std::memory_order_relaxed)) return start(now);
  node_->on_time(now);
}

std::optional<conform::BusTime> PoweredNode::next_wakeup() const {
  if (switch_wanted_.load(std::memory_order_relaxed)) return conform::BusTime{};
  return node_->next_wakeup();
}

}  // namespace refnode
