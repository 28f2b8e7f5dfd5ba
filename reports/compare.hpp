// SPDX-License-Identifier: Apache-2.0
// A comparison of two runs as text for a terminal, as Markdown for a pull request, and as JSON for programs:
// what is worse first, then what is better, then what is merely different.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/console.hpp"
#include "result/compare.hpp"

namespace conform::reports {

inline constexpr int comparison_version = 1;

struct CompareOptions {
  bool strict = false;             ///< a new warning is worse
  std::string old_name, new_name;  ///< what the user called them: files
};

/// One thing that is different. Raw: every writer sanitises.
struct DifferenceLine {
  std::optional<result::Verdict> verdict;  ///< of what is new or gone
  std::string text;
  std::vector<std::string> details;
};
struct DifferenceSection {
  std::string title;
  std::vector<DifferenceLine> lines;
};

/// Only sections with something in them.
[[nodiscard]] std::vector<DifferenceSection> differences(const result::Comparison& comparison);
/// "worse: 1 new failure; 2 failures that the old run has as well do not count"
[[nodiscard]] std::string outcome_words(const result::Comparison& comparison, bool strict);

[[nodiscard]] std::string compare_text(const result::Comparison& comparison, const CompareOptions& options,
                                       const Style& style);
[[nodiscard]] std::string compare_markdown(const result::Comparison& comparison,
                                           const CompareOptions& options);
[[nodiscard]] std::string compare_json(const result::Comparison& comparison, const CompareOptions& options);

}  // namespace conform::reports
