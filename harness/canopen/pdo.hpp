// SPDX-License-Identifier: Apache-2.0
// Which objects belong to a PDO: its communication parameter (1400h-15FFh, 1800h-19FFh) and its mapping
// parameter 200h behind (7.5.2.35 to 7.5.2.38).
#pragma once

#include <cstdint>
#include <optional>

#include "base/strong.hpp"

namespace conform::canopen {

inline constexpr std::uint16_t pdo_mapping_offset = 0x200;

/// The communication parameter of the PDO that either object belongs to; nullopt: it belongs to none.
[[nodiscard]] constexpr std::optional<Index> pdo_communication(Index index) {
  const auto value = index.value();
  if ((value >= 0x1400 && value <= 0x15FF) || (value >= 0x1800 && value <= 0x19FF)) return index;
  if ((value >= 0x1600 && value <= 0x17FF) || (value >= 0x1A00 && value <= 0x1BFF))
    return Index(static_cast<std::uint16_t>(value - pdo_mapping_offset));
  return std::nullopt;
}

/// The mapping parameter beside a communication parameter.
[[nodiscard]] constexpr Index pdo_mapping(Index communication) {
  return Index(static_cast<std::uint16_t>(communication.value() + pdo_mapping_offset));
}

/// The object that a mapping entry names: index in bits 31-16, sub-index in bits 15-8 (7.5.2.36).
[[nodiscard]] constexpr Multiplexer mapped_object(std::uint64_t entry) {
  return {Index(static_cast<std::uint16_t>(entry >> 16U)), SubIndex(static_cast<std::uint8_t>(entry >> 8U))};
}

/// The mapping entry of so many bits of an object.
[[nodiscard]] constexpr std::uint32_t mapping_entry(Multiplexer object, std::uint64_t bits) {
  return (std::uint32_t{object.index.value()} << 16U) | (std::uint32_t{object.sub.value()} << 8U) |
         static_cast<std::uint32_t>(bits & 0xFFU);
}

}  // namespace conform::canopen
