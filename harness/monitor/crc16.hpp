// SPDX-License-Identifier: Apache-2.0
// The check sum of SDO block transfers (CiA 301, 7.2.4.3.16): polynomial 1021h, start 0000h, not reflected.
#pragma once

#include <array>
#include <cstdint>

#include "base/bytes.hpp"

namespace conform::monitor {

namespace detail {
constexpr std::array<std::uint16_t, 256> crc16_table() {
  std::array<std::uint16_t, 256> table{};
  for (unsigned i = 0; i < 256; ++i) {
    unsigned value = i << 8U;
    for (int bit = 0; bit < 8; ++bit) value = (value & 0x8000U) != 0 ? (value << 1U) ^ 0x1021U : value << 1U;
    table[i] = static_cast<std::uint16_t>(value & 0xFFFFU);
  }
  return table;
}
inline constexpr auto crc16_values = crc16_table();
}  // namespace detail

/// Goes on from `crc`, 0 at the beginning: the digits 123456789 give 31C3h.
[[nodiscard]] constexpr std::uint16_t crc16(std::uint16_t crc, ByteView bytes) {
  for (const auto byte : bytes) {
    crc = static_cast<std::uint16_t>((crc << 8U) ^ detail::crc16_values[((crc >> 8U) ^ byte) & 0xFFU]);
  }
  return crc;
}

}  // namespace conform::monitor
