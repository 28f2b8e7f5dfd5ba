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
  if (was_on_) return switch_off(now);
  was_on_ = true;
  start(now);
}

void PoweredNode::switch_off(conform::BusTime now) {
  auto node = Node::create(options_);
  CONFORM_CHECK(node.has_value());  // it could be made of the same options before
  node_ = std::move(*node);
  on_at_ = now + off_time;
}

void PoweredNode::start(conform::BusTime now) {
  on_at_.reset();
  node_->attach(sender_, now);
}

void PoweredNode::on_frame(const conform::can::Frame& frame, conform::BusTime now) {
  if (!on_at_) node_->on_frame(frame, now);
}

void PoweredNode::on_transmitted(conform::BusTime now) {
  if (!on_at_) node_->on_transmitted(now);
}

void PoweredNode::on_time(conform::BusTime now) {
  if (switch_wanted_.exchange(false, std::memory_order_relaxed)) return switch_off(now);
  if (!on_at_) return node_->on_time(now);
  if (*on_at_ <= now) start(now);
}

std::optional<conform::BusTime> PoweredNode::next_wakeup() const {
  if (switch_wanted_.load(std::memory_order_relaxed)) return conform::BusTime{};
  return on_at_ ? on_at_ : node_->next_wakeup();
}

}  // namespace refnode
