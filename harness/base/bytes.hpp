// SPDX-License-Identifier: Apache-2.0
// Byte strings and little-endian integers, the wire order of CANopen (CiA 301, 7.1.4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace conform {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// Reads up to eight bytes, least significant first.
[[nodiscard]] constexpr std::uint64_t load_le(ByteView bytes) {
  std::uint64_t value = 0;
  const std::size_t count = bytes.size() < 8 ? bytes.size() : 8;
  for (std::size_t i = count; i-- > 0;) value = (value << 8U) | bytes[i];
  return value;
}

/// Writes the `bytes.size()` low bytes of `value`, least significant first.
constexpr void store_le(std::span<std::uint8_t> bytes, std::uint64_t value) {
  for (auto& byte : bytes) {
    byte = static_cast<std::uint8_t>(value & 0xFFU);
    value >>= 8U;
  }
}

/// `value` as `size` bytes, least significant first; size 0..8 (further bytes are zero).
[[nodiscard]] inline Bytes to_le(std::uint64_t value, std::size_t size) {
  Bytes out(size);
  store_le(out, value);
  return out;
}

}  // namespace conform
