// SPDX-License-Identifier: Apache-2.0
// Examples of what rules of the lint find, and of the same done right.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace conform::eds {

/// Sections of an EDS; they stand in the place of the sections of a right file that have their names, or
/// behind them. What is before the first section stands at the head of the file, and there a comment
/// "; no [1001]" takes that section, and those of its sub-objects, out of the right file. Of an XDD an
/// element, or the start tag of one, in the place of the one of a right file that is like the right one. The
/// rule finds the wrong one, and nothing in the right one.
struct LintExample {
  std::string_view code;
  std::string_view wrong, right;
  std::string_view file = "example.eds";  ///< where it stands: .dcf and .xdd are other kinds of files
};

[[nodiscard]] std::span<const LintExample> lint_examples();
/// nullptr when there is none: see why_no_example().
[[nodiscard]] const LintExample* find_example(std::string_view code);
/// Why the mistake cannot be shown in a few lines; empty for a rule that has an example.
[[nodiscard]] std::string_view why_no_example(std::string_view code);

/// The text of an example as it is printed: what a terminal does not show, line ends in CR and the byte order
/// mark as well, is written as an escape.
[[nodiscard]] std::string shown(std::string_view example);

}  // namespace conform::eds
