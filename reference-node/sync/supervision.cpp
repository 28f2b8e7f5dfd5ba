// SPDX-License-Identifier: Apache-2.0
#include "sync/supervision.hpp"

#include <chrono>

namespace refnode {

namespace {

constexpr ErrorCause lost{0x8100, ErrorSource::sync, 0};

/// Who produces SYNC (1005h, bit 30) waits for none.
bool produces(const Device& device) { return (device.dictionary.number(0x1005, 0) & 0x4000'0000) != 0; }

}  // namespace

// In Stopped no SYNC is consumed, so none is expected.
void SyncSupervision::on_state_change() {
  if (!device_->works_now(Service::sync)) due_.reset();
}

void SyncSupervision::on_sync() {
  if (!choices.loss_reported) return;
  if (rules.ends()) device_->errors.clear(lost);
  const Duration period = std::chrono::microseconds(device_->time_value(0x1006, 0));
  due_.reset();
  if (period > Duration::zero() && !produces(*device_)) due_ = device_->now + period * 3 / 2;
}

void SyncSupervision::on_time() {
  if (!due_ || device_->now < *due_) return;
  due_.reset();
  // 1006h may have been set to 0 since, or 1005h to a producer.
  if (device_->dictionary.number(0x1006, 0) != 0 && !produces(*device_)) device_->errors.raise(lost, 0);
}

}  // namespace refnode
