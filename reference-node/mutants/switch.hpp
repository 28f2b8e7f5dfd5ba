// SPDX-License-Identifier: Apache-2.0
// What the generated sources of the mutated node ask: is it this fault that is on? See mutate.
#pragma once

#include <cstdint>

namespace conform_mutant {

/// The number of the fault that is on; 0: none.
extern std::uint32_t active;
/// A byte for every number: 1 once its place has been passed.
extern std::uint8_t* const reached;

/// What is computed by the compiler is as it was written.
constexpr bool is(std::uint32_t number) {
  if consteval {
    return false;
  } else {
    reached[number] = 1;
    return number == active;
  }
}

}  // namespace conform_mutant
