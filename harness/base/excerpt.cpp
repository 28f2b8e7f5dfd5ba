// SPDX-License-Identifier: Apache-2.0
#include "base/excerpt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/text.hpp"

namespace conform {
namespace {

constexpr std::size_t window = 100;      // columns of a source line that are shown
constexpr std::size_t window_lead = 40;  // of these before the caret, when the line is clipped on the left
constexpr std::size_t tab_width = 4;
constexpr std::size_t widest_code_point = 4;  // bytes

/// Where to begin, so that more than a window lies before the place: what is before that is clipped anyway.
std::size_t begin_before(std::string_view line, std::size_t offset) {
  constexpr std::size_t most = widest_code_point * window;
  if (offset <= most) return 0;
  auto begin = offset - most;
  // Not inside a code point; in bytes that are no UTF-8 any place will do.
  for (std::size_t i = 1; i < widest_code_point && is_utf8_continuation(line[begin]); ++i) ++begin;
  return begin;
}

}  // namespace

// One code point after the other through printable(), because escapes are wider than what they stand for.
Excerpt excerpt(std::string_view line, std::size_t offset, int length) {
  offset = std::min(offset, line.size());
  std::vector<std::string> cells;  // one printed column each
  std::size_t mark_begin = std::string::npos;
  std::size_t mark_end = 0;
  int marked = 0;
  for (std::size_t i = begin_before(line, offset); i < line.size();) {
    const auto character = line.substr(i, code_point_size(line.substr(i)));
    if (mark_begin == std::string::npos && i + character.size() > offset) mark_begin = cells.size();
    i += character.size();
    const std::string shown = character == "\t" ? std::string(tab_width, ' ') : printable(character);
    for (std::size_t byte = 0; byte < shown.size(); ++byte) {
      if (cells.empty() || byte == 0 || !is_utf8_continuation(shown[byte])) cells.emplace_back();
      cells.back().push_back(shown[byte]);
    }
    if (mark_begin == std::string::npos) continue;
    if (marked++ < std::max(length, 1)) mark_end = cells.size();
    // What lies far behind the mark is clipped, too.
    if (cells.size() > mark_begin + 2 * window) break;
  }
  if (mark_begin == std::string::npos) mark_begin = cells.size();
  mark_end = std::max(mark_end, mark_begin + 1);

  std::size_t first = 0;
  if (mark_begin > window - window_lead / 2) first = mark_begin - window_lead;
  const std::size_t last = std::min(cells.size(), first + window);
  Excerpt out;
  if (first > 0) out.text += "...";
  for (std::size_t i = first; i < last; ++i) out.text += cells[i];
  if (last < cells.size()) out.text += "...";
  out.underline.assign(mark_begin - first + (first > 0 ? 3 : 0), ' ');
  out.underline += '^';
  const std::size_t shown_end = std::min(mark_end, std::max(last, mark_begin + 1));
  out.underline.append(shown_end - mark_begin - 1, '~');
  return out;
}

std::string to_lines(const Excerpt& excerpt, int line_number, std::string_view tint, std::string_view off) {
  const std::string text = excerpt.text.empty() ? "" : " " + excerpt.text;
  return fmt::format("{:5} |{}\n      | {}{}{}\n", line_number, text, tint, excerpt.underline, off);
}

}  // namespace conform
