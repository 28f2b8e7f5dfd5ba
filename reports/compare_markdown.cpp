// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "reports/compare.hpp"
#include "reports/markdown_text.hpp"
#include "reports/phrases.hpp"

namespace conform::reports {

std::string compare_markdown(const result::Comparison& comparison, const CompareOptions& options) {
  // Comments of pull requests have a limit; the JSON has all.
  constexpr std::size_t most_lines = 50;
  std::string out =
      fmt::format("## {}\n\n{} against {}\n", escaped(outcome_words(comparison, options.strict)),
                  code(options.new_name), code(options.old_name));
  for (const auto& section : differences(comparison)) {
    out += fmt::format("\n### {} ({})\n\n", section.title, section.count);
    const auto shown = std::min(most_lines, section.lines.size());
    for (std::size_t i = 0; i < shown; ++i) {
      const auto& line = section.lines[i];
      const bool is_cause = line.verdict && (section.title == "New" || section.title == "Gone");
      out += "- " + (is_cause ? fmt::format("**{}** ", verdict_words(*line.verdict)) : std::string());
      out += escaped(line.text) + "\n";
      for (const auto& detail : line.details) out += "  - " + escaped(detail) + "\n";
    }
    if (shown < section.lines.size()) out += fmt::format("- ... and {} more\n", section.lines.size() - shown);
  }
  return out;
}

}  // namespace conform::reports
