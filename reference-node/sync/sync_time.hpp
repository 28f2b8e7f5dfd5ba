// SPDX-License-Identifier: Apache-2.0
// Consumer of SYNC (1005h to 1007h, 1019h) and TIME (1012h); the node produces neither.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "cob-id/cob_id_rules.hpp"
#include "device/device.hpp"
#include "emergency/emergency.hpp"

namespace refnode {

class SyncConsumer {
 public:
  SyncConsumer(Device& device, Emergency& emergency);

  /// 1005h, 1006h, 1007h, 1019h.
  void add_objects();
  void bind();

  std::function<void(std::optional<std::uint8_t> counter)> on_sync;

  /// True when the frame was a SYNC.
  bool on_frame(const Frame& frame);

 private:
  [[nodiscard]] Accepted check_overflow(ByteView bytes) const;
  [[nodiscard]] std::uint64_t overflow() const;

  Device* device_;
  Emergency* emergency_;
  CobIdRules cob_id_;
};

class TimeConsumer {
 public:
  explicit TimeConsumer(Device& device);

  /// 1012h, and 2F10h that shows the time.
  void add_objects();
  void bind() { cob_id_.bind(); }

  /// Takes the time over into 2F10h; true when the frame was a TIME message to be consumed.
  bool on_frame(const Frame& frame);

 private:
  Device* device_;
  CobIdRules cob_id_;
};

}  // namespace refnode
