// SPDX-License-Identifier: Apache-2.0
// The reference node behind a power switch.
#pragma once

#include <atomic>
#include <memory>

#include "node/node.hpp"

namespace refnode {

/// Without power the node forgets everything but its non-volatile memory: it is made anew, with the same
/// switches and the same memory.
class PoweredNode final : public conform::can::Participant {
 public:
  /// Fails as Node::create() does. Without `storage` the memory lives as long as this object.
  [[nodiscard]] static conform::Result<std::unique_ptr<PoweredNode>> create(Options options);

  /// Power on. Attached once more it has been off in between.
  void attach(Sender sender, conform::BusTime now) override;
  void on_frame(const conform::can::Frame& frame, conform::BusTime now) override;
  void on_transmitted(conform::BusTime now) override;
  void on_time(conform::BusTime now) override;
  [[nodiscard]] std::optional<conform::BusTime> next_wakeup() const override;

  /// Async-signal-safe: the power goes off and on at the next wake-up, which is due at once.
  void switch_power() noexcept { switch_wanted_.store(true, std::memory_order_relaxed); }

  [[nodiscard]] const Node& node() const { return *node_; }

 private:
  PoweredNode(Options options, std::unique_ptr<Node> node)
      : options_(std::move(options)), node_(std::move(node)) {}
  void start(conform::BusTime now);

  static_assert(std::atomic<bool>::is_always_lock_free);
  Options options_;
  std::unique_ptr<Node> node_;
  Sender sender_;
  bool was_on_ = false;
  std::atomic<bool> switch_wanted_{false};
};

}  // namespace refnode
