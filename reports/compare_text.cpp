// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "reports/compare.hpp"
#include "reports/paint.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports {
namespace {

constexpr std::size_t most_lines = 30;  ///< of a section; the JSON has all
constexpr std::size_t most_columns = 400;

void put(std::string& out, std::string_view front, std::string_view text, std::size_t width) {
  bool first = true;
  const std::string blanks(columns(front) + 2, ' ');
  for (const auto& part : wrap(clip(log_safe(text), most_columns), width - blanks.size())) {
    out += (first ? std::string(front) : blanks) + part + "\n";
    first = false;
  }
}

}  // namespace

std::string compare_text(const result::Comparison& comparison, const CompareOptions& options,
                         const Style& style) {
  const auto width = std::max<std::size_t>(style.width, 60);
  std::string out;
  put(out, "old  ", options.old_name, width);
  put(out, "new  ", options.new_name, width);
  for (const auto& section : differences(comparison)) {
    const auto title = fmt::format("{} ({})", section.title, section.count);
    out += "\n" + paint(title, Ink::strong, style) + "\n";
    for (std::size_t i = 0; i < section.lines.size(); ++i) {
      if (i == most_lines) {
        out += fmt::format("  ... and {} more, --format json has all\n", section.lines.size() - i);
        break;
      }
      const auto& line = section.lines[i];
      std::string text;
      if (line.verdict && (section.title == "New" || section.title == "Gone"))
        text = fmt::format("{} ", verdict_words(*line.verdict));
      put(out, "  ", text + line.text, width);
      for (const auto& detail : line.details) put(out, "      ", detail, width);
    }
  }
  const int code = exit_code(comparison, options.strict);
  const Ink ink = code == 0 ? Ink::good : code == 1 ? Ink::bad : Ink::unsure;
  out += "\n" + paint(outcome_words(comparison, options.strict), ink, style) + "\n";
  return out;
}

}  // namespace conform::reports
