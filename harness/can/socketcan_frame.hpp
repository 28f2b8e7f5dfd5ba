// SPDX-License-Identifier: Apache-2.0
// Our frame and the kernel's `struct can_frame`.
#pragma once

#include <linux/can.h>

#include <algorithm>

#include "can/frame.hpp"

namespace conform::can {

[[nodiscard]] inline can_frame to_kernel(const Frame& frame) {
  can_frame raw{};
  raw.can_id = frame.id & CAN_EFF_MASK;
  if (frame.extended) raw.can_id |= CAN_EFF_FLAG;
  if (frame.remote) raw.can_id |= CAN_RTR_FLAG;
  if (frame.error) raw.can_id |= CAN_ERR_FLAG;
  raw.len = std::min<std::uint8_t>(frame.dlc, CAN_MAX_DLEN);
  // Drivers without this feature ignore the field and send a length code of 8.
  raw.len8_dlc = frame.dlc > CAN_MAX_DLEN ? frame.dlc : std::uint8_t{0};
  std::copy(frame.data.begin(), frame.data.end(), raw.data);
  return raw;
}

/// `raw.len` must be at most 8. An identifier above 7FFh without the extended flag stays as it is.
[[nodiscard]] inline Frame from_kernel(const can_frame& raw) {
  Frame frame;
  frame.id = raw.can_id & CAN_EFF_MASK;
  frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
  frame.remote = (raw.can_id & CAN_RTR_FLAG) != 0;
  frame.error = (raw.can_id & CAN_ERR_FLAG) != 0;
  const bool long_code =
      raw.len == CAN_MAX_DLEN && raw.len8_dlc > CAN_MAX_DLEN && raw.len8_dlc <= CAN_MAX_RAW_DLC;
  frame.dlc = long_code ? raw.len8_dlc : raw.len;
  // Bytes behind the length are whatever was in memory; equal frames shall compare equal.
  std::copy_n(raw.data, frame.size(), frame.data.begin());
  return frame;
}

}  // namespace conform::can
