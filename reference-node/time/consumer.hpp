// SPDX-License-Identifier: Apache-2.0
// Consumer of TIME (1012h; CiA 301, 7.2.6).
#pragma once

#include <functional>

#include "cob-id/cob_id.hpp"
#include "device/device.hpp"

namespace refnode {

class TimeConsumer {
 public:
  explicit TimeConsumer(Device& device);
  TimeConsumer(const TimeConsumer&) = delete;
  TimeConsumer& operator=(const TimeConsumer&) = delete;

  CobIdRules cob_id_rules{CobIdUse::time};

  /// 1012h, and 2F10h that shows the time.
  void add_objects();
  void bind() { cob_id_.bind(); }

  /// A time was received: milliseconds after midnight, days since 1984-01-01.
  std::function<void(std::uint32_t milliseconds, std::uint16_t days)> on_time_of_day;

  /// Takes the time over into 2F10h; true when the frame was a TIME message to be consumed.
  bool on_frame(const Frame& frame);

 private:
  Device* device_;
  CobId cob_id_;
};

}  // namespace refnode
