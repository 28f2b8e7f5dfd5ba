// SPDX-License-Identifier: Apache-2.0
// The synchronous window (1007h, CiA 301, 7.5.2.7): the time behind a SYNC in which synchronous PDOs are
// exchanged. What comes later may be discarded until the next SYNC, and is here.
#pragma once

#include <cstdint>
#include <optional>

#include "device/device.hpp"

namespace refnode {

struct SyncWindowChoices {
  bool late_discarded = true;  ///< synchronous RPDOs behind the window
};

struct SyncWindowRules {
  /// 1007h counts in microseconds; 0: there is no window.
  Rule<Duration(std::int64_t value)> length;
  /// The window begins with every SYNC.
  Rule<bool(Duration since_sync, Duration window)> open;
  SyncWindowRules();
};

class SyncWindow {
 public:
  explicit SyncWindow(Device& device) : device_(&device) {}
  SyncWindow(const SyncWindow&) = delete;
  SyncWindow& operator=(const SyncWindow&) = delete;

  SyncWindowChoices choices;
  SyncWindowRules rules;

  void on_reset() { began_.reset(); }
  void on_sync() { began_ = device_->now; }
  /// Whether a synchronous RPDO that comes now is kept for the next SYNC.
  [[nodiscard]] bool takes_rpdo() const;

 private:
  Device* device_;
  std::optional<BusTime> began_;
};

}  // namespace refnode
