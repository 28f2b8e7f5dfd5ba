// SPDX-License-Identifier: Apache-2.0
// Reproducible random numbers: the same with every compiler and library, unlike the distributions of std.
#pragma once

#include <cstdint>

namespace conform {

/// One step of splitmix64 on `state`, which is the seed at first.
[[nodiscard]] constexpr std::uint64_t next_random(std::uint64_t& state) {
  state += 0x9E3779B97F4A7C15U;
  std::uint64_t z = state;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

}  // namespace conform
