// SPDX-License-Identifier: Apache-2.0
// Node guarding and life guarding (100Ch, 100Dh, CiA 301, 7.2.8.2.2, 7.5.2.11, 7.5.2.12). While the heartbeat
// is on there is neither.
#pragma once

#include <functional>
#include <optional>

#include "device/device.hpp"

namespace refnode {

class NodeGuarding {
 public:
  explicit NodeGuarding(Device& device) : device_(&device) {}

  /// 100Ch, 100Dh
  void add_objects();
  void bind();

  std::function<void()> on_loss;  ///< the master does not guard any more

  /// True when the frame was a guard request.
  bool on_remote(const Frame& frame);
  void on_reset();
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const { return due_; }

 private:
  [[nodiscard]] bool in_use() const;
  [[nodiscard]] Duration life_time() const;

  Device* device_;
  bool toggle_ = false;
  bool lost_ = false;
  std::optional<BusTime> due_;  ///< set by the first guard request
};

}  // namespace refnode
