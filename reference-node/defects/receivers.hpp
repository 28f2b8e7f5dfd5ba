// SPDX-License-Identifier: Apache-2.0
// Faults of a receiver that many services may have: filters that look at a part of an identifier, buffers
// that hold one frame, drivers that hand on what was received before.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "defects/hooks.hpp"

namespace refnode::defect {

inline bool is_nmt_command(const Frame& frame) {
  return frame.id == 0x000 && !frame.extended && !frame.remote && frame.size() == 2;
}

/// An NMT command that this node has to obey.
inline bool is_for(const Parts& parts, const Frame& frame) {
  return frame.data[1] == 0 || frame.data[1] == parts.device.node_id;
}

inline bool is_guard_request(const Parts& parts, const Frame& frame) {
  return frame.remote && !frame.extended && frame.id == 0x700U + parts.device.node_id;
}

inline bool is_sync(const Parts& parts, const Frame& frame) {
  return !frame.extended && !frame.remote &&
         frame.id == (parts.device.dictionary.number(0x1005, 0, 0x80) & 0x7FFU);
}

/// A part of a 29-bit identifier, or of a CAN-ID, that is looked at in place of the whole.
using Part = std::uint32_t (*)(const Frame&);

/// Extended frames are base frames by the upper eleven bits of their identifier: the filter looks there only.
inline std::uint32_t upper_bits(const Frame& frame) { return frame.extended ? frame.id >> 18U : frame.id; }
/// ... or by the lower ones: the rest is cut.
inline std::uint32_t lower_bits(const Frame& frame) { return frame.id & 0x7FFU; }

/// Data frames for the CAN-IDs from `first` to `last` are those for which `part` says so. The right ones
/// stay.
[[nodiscard]] inline Change known_by(Part part, std::uint32_t first, std::uint32_t last) {
  return misreads([part, first, last](Parts&, Frame& frame) {
    // With a whole CAN-ID in an extended frame it would be known to many.
    if (!frame.extended || frame.remote || frame.id <= 0x7FFU) return;
    const std::uint32_t id = part(frame);
    if (id < first || id > last) return;
    frame.id = id;
    frame.extended = false;
  });
}

/// A remote frame with the CAN-ID of such frames is the last of them once more.
[[nodiscard]] inline Change repeats_by_remote_frame(std::uint32_t id, bool (*of_them)(const Frame&)) {
  return misreads([id, of_them, last = std::optional<Frame>{}](Parts&, Frame& frame) mutable {
    if (of_them(frame)) last = frame;
    if (frame.id == id && frame.remote && !frame.extended && last) frame = *last;
  });
}

/// One receive buffer for such frames: one right behind another is lost.
[[nodiscard]] inline Change has_one_buffer_for(bool (*such)(const Frame&)) {
  return [such](Parts& parts) {
    const auto last = std::make_shared<std::optional<BusTime>>();
    deaf_to([such, last](Parts& node, const Frame& frame) {
      constexpr Duration until_read = std::chrono::milliseconds(1);
      if (!such(frame)) return false;
      const auto before = std::exchange(*last, node.device.now);
      return before && node.device.now - *before < until_read;
    })(parts);
  };
}

}  // namespace refnode::defect
