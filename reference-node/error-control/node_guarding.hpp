// SPDX-License-Identifier: Apache-2.0
// Node guarding and life guarding (100Ch, 100Dh, CiA 301, 7.2.8.2.2, 7.5.2.11, 7.5.2.12). While the heartbeat
// is on there is neither.
#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "device/device.hpp"
#include "rules/rule.hpp"

namespace refnode {

/// What CiA 301 leaves to the maker of the device.
struct GuardingChoices {
  bool answered_as_heartbeat = false;  ///< requests beside the heartbeat, with the state and no toggle bit
};

/// What CiA 301, 7.2.8.2.2 and 7.2.8.3.2 say of guarding.
struct GuardingRules {
  /// While the heartbeat is on there is neither node guarding nor life guarding.
  Rule<bool(std::uint64_t heartbeat_time)> is_used = [](std::uint64_t heartbeat_time) {
    return heartbeat_time == 0;
  };
  /// Nobody is answered before the boot-up message.
  Rule<bool(NmtState)> is_answered_in = [](NmtState state) { return state != NmtState::initialising; };
  /// Where there is no life guarding, a request is answered all the same (7.5.2.11: only life guarding is
  /// off).
  Rule<bool(Duration life_time)> is_answered_with = [](Duration) { return true; };
  /// The life time: guard time (100Ch, ms) times factor (100Dh); zero, where either is: no life guarding.
  Rule<Duration(std::uint64_t, std::uint64_t)> life_time = [](std::uint64_t guard_time,
                                                              std::uint64_t factor) {
    return Duration(std::chrono::milliseconds(static_cast<std::int64_t>(guard_time * factor)));
  };
  /// The first request begins the watch; that it was configured does not.
  Rule<bool(bool requested)> begins_the_watch = [](bool requested) { return requested; };
  /// Behind a reset the watch waits for a request again.
  Rule<bool()> ends_with_reset = [] { return true; };
};

class NodeGuarding {
 public:
  explicit NodeGuarding(Device& device) : device_(&device) {}

  /// 100Ch, 100Dh
  void add_objects();
  void bind();

  GuardingRules rules;
  GuardingChoices choices;
  std::function<void()> on_loss;  ///< the master does not guard any more

  /// True when the frame was a guard request.
  bool on_remote(const Frame& frame);
  void on_reset();
  /// With 0, as behind a reset.
  void begin_toggle_anew() { toggle_ = false; }
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const { return due_; }

 private:
  [[nodiscard]] bool in_use() const;
  [[nodiscard]] Duration life_time() const;
  void watch(bool requested);

  Device* device_;
  bool toggle_ = false;
  bool lost_ = false;
  std::optional<BusTime> due_;  ///< set by the first guard request
};

}  // namespace refnode
