// SPDX-License-Identifier: Apache-2.0
// A comparison of two runs as text for a terminal, as Markdown for a pull request, as a page for a browser,
// and as JSON for programs: what is worse first, then what is better, then what is merely different.
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
  std::size_t count = lines.size();  ///< of what differs; a line may tell several that do alike
};

/// Only sections with something in them.
[[nodiscard]] std::vector<DifferenceSection> differences(const result::Comparison& comparison);
/// Of an entry that may have changed by itself.
inline constexpr std::string_view process_words = "may be a value of the process, and does not count";
/// "SDO answer 1018h:01", "SDO answer, all of them"
[[nodiscard]] std::string times_title(const result::TimesChange& change);
/// "median 5.0 ms, was 2.0 ms"
[[nodiscard]] std::string times_words(const result::TimesChange& change);
/// How sure that is: "longer in 97 % of all pairs; by chance: less than 1e-9 (200 and 200 samples)"
[[nodiscard]] std::string certainty_words(const result::TimesChange& change);

struct Outcome {
  int code = 0;  ///< exit code
  std::string_view
      head;  ///< worse, not decided, no difference, better, "different, but not worse", not worse
  std::vector<std::string> parts;  ///< why: "1 new failure"
};
[[nodiscard]] Outcome outcome_of(const result::Comparison& comparison, bool strict);
/// "worse: 1 new failure; 2 failures that the old run has as well do not count"
[[nodiscard]] std::string outcome_words(const result::Comparison& comparison, bool strict);

[[nodiscard]] std::string compare_text(const result::Comparison& comparison, const CompareOptions& options,
                                       const Style& style);
[[nodiscard]] std::string compare_markdown(const result::Comparison& comparison,
                                           const CompareOptions& options);
/// A document like that of a run (html/html.hpp). `comparison` knows both runs.
[[nodiscard]] std::string compare_html(const result::Comparison& comparison, const CompareOptions& options);
/// By reports/schema/comparison.schema.json.
[[nodiscard]] std::string compare_json(const result::Comparison& comparison, const CompareOptions& options);

}  // namespace conform::reports
