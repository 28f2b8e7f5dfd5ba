// SPDX-License-Identifier: Apache-2.0
// Verdicts as a bar of shares: each kind has a pattern of its own, so that it is told apart in black and
// white.
#pragma once

#include <string>

#include "result/run_result.hpp"

namespace conform::reports::html {

/// The patterns that the bars are filled with; once on a page.
[[nodiscard]] std::string bar_patterns();
/// A drawing without words: what it shows must stand in numbers beside it.
[[nodiscard]] std::string bar(const result::Counts& counts);
/// The counts in words, worst first, each with its badge: "3 fail  20 pass"; what is not there is left out.
/// `not_judged`: requirements without a verdict.
[[nodiscard]] std::string count_badges(const result::Counts& counts, std::size_t not_judged = 0);

}  // namespace conform::reports::html
