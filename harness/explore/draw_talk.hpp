// SPDX-License-Identifier: Apache-2.0
// What the files that draw talk of whole services share.
#pragma once

#include <cstdint>

#include "explore/draw.hpp"

namespace conform::explore::talk {

inline constexpr std::uint32_t not_valid = 0x8000'0000;
inline constexpr std::uint8_t start = 1, stop = 2, pre_operational = 0x80, reset_node = 0x81,
                              reset_communication = 0x82;

/// Just before, at and just behind a time.
[[nodiscard]] Duration edge(Draft& draft, Duration time);

// By file: draw_pdo.cpp,
void draw_sync(Draft& draft);
void draw_sync_producer(Draft& draft);
void draw_rpdo(Draft& draft);
void draw_tpdo(Draft& draft);
// draw_lss.cpp,
void draw_lss(Draft& draft);
// draw_channels.cpp.
void draw_channels(Draft& draft);

}  // namespace conform::explore::talk
