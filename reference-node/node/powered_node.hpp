// SPDX-License-Identifier: Apache-2.0
// The reference node behind a power switch.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "node/node.hpp"

namespace refnode {

/// Without power the node forgets everything but its non-volatile memory: it is made anew, with the same
/// switches and the same memory.
class PoweredNode final : public conform::can::Participant {
 public:
  /// Fails as Node::create() does. Without `storage` the memory lives as long as this object.
  [[nodiscard]] static conform::Result<std::unique_ptr<PoweredNode>> create(Options options);

  /// How long the power is off: so long that nobody takes the start for a part of the one before.
  static constexpr conform::Duration off_time = std::chrono::milliseconds(600);

  /// Power on. Attached once more it has been off in between, and is for the off time from now on.
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
  void switch_off(conform::BusTime now);
  void start(conform::BusTime now);

  static_assert(std::atomic<bool>::is_always_lock_free);
  Options options_;
  std::unique_ptr<Node> node_;
  Sender sender_;
  bool was_on_ = false;
  std::optional<conform::BusTime> on_at_;  ///< while the power is off: when it comes back
  std::atomic<bool> switch_wanted_{false};
};

}  // namespace refnode
