// SPDX-License-Identifier: Apache-2.0
// Examples of what rules of the lint find, and of the same done right.
#pragma once

#include <span>
#include <string_view>

namespace conform::eds {

/// Sections of an EDS; they stand in the place of the sections of a right file that have their names, or
/// behind them. The rule finds the wrong one, and nothing in the right one.
struct LintExample {
  std::string_view code;
  std::string_view wrong, right;
};

[[nodiscard]] std::span<const LintExample> lint_examples();
/// nullptr when there is none: some mistakes cannot be shown in a few lines.
[[nodiscard]] const LintExample* find_example(std::string_view code);

}  // namespace conform::eds
