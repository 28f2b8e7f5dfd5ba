// SPDX-License-Identifier: Apache-2.0
// FNV-1a with 64 bits: a short name for a text, the same on every machine and in every version. No protection
// against anybody who wants two texts of one name.
#pragma once

#include <cstdint>
#include <string_view>

namespace conform {

inline constexpr std::uint64_t fnv1a_of_nothing = 0xCBF29CE484222325U;

/// Of `text` behind what `before` was made of.
[[nodiscard]] constexpr std::uint64_t fnv1a(std::string_view text, std::uint64_t before = fnv1a_of_nothing) {
  for (const char each : text) before = (before ^ static_cast<std::uint8_t>(each)) * 0x100000001B3U;
  return before;
}

}  // namespace conform
