// SPDX-License-Identifier: Apache-2.0
// Two runs with every kind of difference between them.
#pragma once

#include <string>

#include "result/compare.hpp"
#include "result/run_result.hpp"

namespace conform::reports::testing {

/// Runs to compare; what they are compared by points into them.
struct Pair {
  result::RunResult before, after;
};
/// The sample run and what came before it, with a `text` that is the device's in every difference.
[[nodiscard]] Pair sample_pair(const std::string& text);
/// The same device, told to be the one and the other: no difference.
[[nodiscard]] Pair same_pair();

}  // namespace conform::reports::testing
