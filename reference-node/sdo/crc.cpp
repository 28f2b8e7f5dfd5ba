// SPDX-License-Identifier: Apache-2.0
#include "sdo/crc.hpp"

#include <array>

namespace refnode {

namespace {

// Entry i: what the top byte i of the register adds when it is shifted out.
constexpr auto table = [] {
  std::array<std::uint16_t, 256> made{};
  for (unsigned i = 0; i < 256; ++i) {
    unsigned remainder = i << 8U;
    for (int bit = 0; bit < 8; ++bit) {
      remainder = (remainder & 0x8000U) != 0 ? (remainder << 1U) ^ 0x1021U : remainder << 1U;
    }
    made[i] = static_cast<std::uint16_t>(remainder & 0xFFFFU);
  }
  return made;
}();

}  // namespace

std::uint16_t sdo_crc(conform::ByteView bytes, std::uint16_t before) {
  unsigned crc = before;
  for (const std::uint8_t byte : bytes) crc = ((crc << 8U) & 0xFFFFU) ^ table[(crc >> 8U) ^ byte];
  return static_cast<std::uint16_t>(crc);
}

}  // namespace refnode
