// SPDX-License-Identifier: Apache-2.0
// Where a value is in the data of a PDO: bits are numbered as they are sent, the least significant of the
// first byte comes first (CiA 301, 7.1.4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace refnode {

[[nodiscard]] constexpr std::size_t whole_bytes(std::size_t bits) { return (bits + 7) / 8; }

/// Puts `count` bits of `from`, the first of them `first`, in the place of those of `to` from `target` on.
inline void copy_bits(std::span<const std::uint8_t> from, std::size_t first, std::span<std::uint8_t> to,
                      std::size_t target, std::size_t count) {
  for (std::size_t bit = 0; bit < count; ++bit) {
    const unsigned value = (from[(first + bit) / 8] >> ((first + bit) % 8)) & 1U;
    const unsigned place = (target + bit) % 8;
    auto& byte = to[(target + bit) / 8];
    byte = static_cast<std::uint8_t>((byte & ~(1U << place)) | (value << place));
  }
}

}  // namespace refnode
