// SPDX-License-Identifier: Apache-2.0
// What a consumer of SYNC may do with the communication cycle period (1006h, CiA 301, 7.5.2.6): expect a SYNC
// once in a period and a half, from the first one on, and tell of the one that stays away. CiA 301 asks no
// consumer for it, and this one does it only where it is chosen.
#pragma once

#include <optional>

#include "device/device.hpp"

namespace refnode {

struct SyncSupervisionChoices {
  bool loss_reported = false;  ///< EMCY 8100h, until the next SYNC
};

struct SyncSupervisionRules {
  /// The error is gone with the next SYNC.
  Rule<bool()> ends{[] { return true; }};
};

class SyncSupervision {
 public:
  explicit SyncSupervision(Device& device) : device_(&device) {}
  SyncSupervision(const SyncSupervision&) = delete;
  SyncSupervision& operator=(const SyncSupervision&) = delete;

  SyncSupervisionChoices choices;
  SyncSupervisionRules rules;

  void on_reset() { due_.reset(); }
  void on_state_change();
  void on_sync();
  void on_time();
  [[nodiscard]] std::optional<BusTime> next_wakeup() const { return due_; }

 private:
  Device* device_;
  std::optional<BusTime> due_;
};

}  // namespace refnode
