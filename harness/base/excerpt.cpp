// SPDX-License-Identifier: Apache-2.0
#include "base/excerpt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/text.hpp"

namespace conform {
namespace {

constexpr int window = 100;      // columns of a source line that are shown
constexpr int window_lead = 40;  // of these before the caret, when the line is clipped on the left
constexpr int tab_width = 4;

constexpr bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

}  // namespace

int code_points(std::string_view text) {
  int count = 0;
  bool inside = false;  // behind a lead byte; a stray continuation byte counts for itself
  for (const char c : text) {
    const bool continuation = is_continuation(c);
    if (!continuation || !inside) ++count;
    inside = continuation ? inside : static_cast<unsigned char>(c) >= 0xC0U;
  }
  return count;
}

// One code point after the other through printable(), because escapes are wider than what they stand for.
Excerpt excerpt(std::string_view line, int column, int length) {
  std::vector<std::string> cells;  // one printed column each
  std::size_t mark_begin = std::string::npos;
  std::size_t mark_end = 0;
  int at = 1;
  const auto end_of_mark = static_cast<long>(column) + std::max(length, 1);
  for (std::size_t i = 0; i < line.size(); ++at) {
    std::size_t next = i + 1;
    while (next < line.size() && code_points(line.substr(i, next + 1 - i)) == 1) ++next;
    const auto character = line.substr(i, next - i);
    i = next;
    if (at == column) mark_begin = cells.size();
    const std::string shown = character == "\t" ? std::string(tab_width, ' ') : printable(character);
    for (std::size_t byte = 0; byte < shown.size(); ++byte) {
      if (cells.empty() || byte == 0 || (static_cast<unsigned char>(shown[byte]) & 0xC0U) != 0x80U)
        cells.emplace_back();
      cells.back().push_back(shown[byte]);
    }
    if (at >= column && at < end_of_mark) mark_end = cells.size();
    // What lies far behind the mark is clipped anyway.
    if (at > column && cells.size() > mark_begin + 2U * window) break;
  }
  if (mark_begin == std::string::npos) mark_begin = cells.size();
  mark_end = std::max(mark_end, mark_begin + 1);

  std::size_t first = 0;
  if (mark_begin > static_cast<std::size_t>(window - window_lead / 2)) first = mark_begin - window_lead;
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
