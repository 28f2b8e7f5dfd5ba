// SPDX-License-Identifier: Apache-2.0
#include "sync/window.hpp"

#include <chrono>

namespace refnode {

SyncWindowRules::SyncWindowRules()
    : length([](std::int64_t value) -> Duration { return std::chrono::microseconds(value); }),
      open([](Duration since_sync, Duration window) {
        return window == Duration::zero() || since_sync <= window;
      }) {}

bool SyncWindow::takes_rpdo() const {
  if (!began_ || !choices.late_discarded) return true;
  return rules.open(device_->now - *began_, rules.length(device_->time_value(0x1007, 0)));
}

}  // namespace refnode
