// SPDX-License-Identifier: Apache-2.0
#include "eds/text_lines.hpp"

#include <algorithm>

namespace conform::eds {

std::size_t end_of_line(std::string_view bytes, std::size_t from) {
  // Two looks for one byte each are faster than one look for either; in parts, because a file may have no LF.
  constexpr std::size_t part = 512;
  for (; from < bytes.size(); from += part) {
    const auto here = bytes.substr(from, part);
    const auto feed = std::min(here.find('\n'), here.size());
    const auto end = std::min(here.substr(0, feed).find('\r'), feed);
    if (end < here.size()) return from + end;
  }
  return bytes.size();
}

TextLines::TextLines(std::string_view bytes) : bytes_(bytes) {
  constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";
  std::size_t at = bytes.starts_with(utf8_mark) ? utf8_mark.size() : 0;
  const LineEnds ends(bytes);
  while (at < bytes.size()) {
    starts_.push_back(at);
    at = ends.from(at);
    if (at == bytes.size()) break;
    at += bytes.substr(at).starts_with("\r\n") ? 2U : 1U;
  }
}

std::size_t TextLines::start(std::size_t number) const {
  return number == 0 || number > starts_.size() ? bytes_.size() : starts_[number - 1];
}

std::string_view TextLines::line(std::size_t number) const {
  const auto begin = start(number);
  return bytes_.substr(begin, end_of_line(bytes_, begin) - begin);
}

std::optional<std::size_t> TextLines::offset(Position at) const {
  if (at.line == 0 || at.column == 0 || at.line > starts_.size()) return std::nullopt;
  if (at.column - 1 > line(at.line).size()) return std::nullopt;
  return starts_[at.line - 1] + at.column - 1;
}

Position TextLines::position(std::size_t offset) const {
  const auto next = std::ranges::upper_bound(starts_, offset);
  if (next == starts_.begin()) return {1, 1};
  // Behind the last end of line another line could begin.
  if (offset == bytes_.size() && (bytes_.ends_with('\n') || bytes_.ends_with('\r')))
    return {static_cast<std::uint32_t>(starts_.size() + 1), 1};
  return {static_cast<std::uint32_t>(next - starts_.begin()),
          static_cast<std::uint32_t>(offset - *(next - 1) + 1)};
}

std::string_view TextLines::line_end() const {
  const auto end = bytes_.find_first_of("\r\n");
  if (end == std::string_view::npos || bytes_[end] == '\n') return "\n";
  return bytes_.substr(end).starts_with("\r\n") ? "\r\n" : "\r";
}

}  // namespace conform::eds
