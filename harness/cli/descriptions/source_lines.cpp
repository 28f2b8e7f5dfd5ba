// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/source_lines.hpp"

#include <algorithm>

#include "base/excerpt.hpp"
#include "base/text.hpp"

namespace conform::cli {

int SourceLines::column(eds::Position at) {
  if (at.line == 0 || at.line > lines_.count()) return static_cast<int>(at.column);
  if (at.line != counted_.line || at.column < counted_.column) {
    counted_ = {at.line, 1};
    counted_column_ = 1;
  }
  const auto line = lines_.line(at.line);
  const auto begin = std::min<std::size_t>(counted_.column - 1, line.size());
  counted_column_ += code_points(line.substr(begin, at.column - counted_.column));
  counted_ = at;
  return counted_column_;
}

std::string SourceLines::excerpt_at(eds::Position at, std::string_view tint, std::string_view off) const {
  // What is missing from the file as a whole stands at its begin.
  const bool whole_file = at == eds::Position{1, 1};
  if (whole_file || !at.known() || at.line > lines_.count()) return {};
  return to_lines(excerpt(lines_.line(at.line), at.column - 1, 1), static_cast<int>(at.line), tint, off);
}

std::string with_hint(const eds::Finding& finding) {
  return printable(finding.message) + (finding.hint.empty() ? "" : "; " + printable(finding.hint));
}

}  // namespace conform::cli
