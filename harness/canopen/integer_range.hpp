// SPDX-License-Identifier: Apache-2.0
// What an INTEGERn or UNSIGNEDn can hold.
#pragma once

#include <cstdint>
#include <optional>

#include "canopen/data_type.hpp"

namespace conform::canopen {

/// The greatest value of the type, or the least, as 64-bit two's complement; nullopt: it is no integer.
[[nodiscard]] inline std::optional<std::uint64_t> end_of_range(DataType type, bool upper) {
  const auto size = size_bytes(type);
  if (!is_integer(type) || !size) return std::nullopt;
  const auto all = *size == 8 ? ~std::uint64_t{0} : (std::uint64_t{1} << (8 * *size)) - 1;
  if (is_signed(type)) return upper ? all >> 1U : ~(all >> 1U);
  return upper ? all : 0;
}

}  // namespace conform::canopen
