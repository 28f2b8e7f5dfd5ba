// SPDX-License-Identifier: Apache-2.0
#include "reports/html/difference.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/html/markup.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {
namespace {

/// What stays of a long text in front of what differs.
constexpr std::size_t context = 24;

/// Texts that are alike in less than so many bytes are simply two texts.
constexpr std::size_t alike = 4;

std::string shown(std::string_view whole, const SharedEnds& ends, std::size_t width) {
  if (whole.empty()) return "<span class=\"quiet\">(not there)</span>";
  const bool is_long = columns(whole) > width;
  std::size_t from = is_long && ends.begin > 2 * context ? ends.begin - context : 0;
  while (from > 0 && from < whole.size() && is_utf8_continuation(whole[from])) --from;
  const std::string_view front = whole.substr(from, ends.begin - from);
  const std::string_view middle = whole.substr(ends.begin, whole.size() - ends.begin - ends.end);
  const std::string_view back = whole.substr(whole.size() - ends.end);
  const std::string cut = clip(middle, width);
  std::string out = from == 0 ? "" : "... ";
  const bool is_part = ends.begin + ends.end >= alike && !middle.empty();
  out += text(front) + (is_part ? fmt::format("<mark>{}</mark>", text(cut)) : text(cut));
  const std::size_t left = width - std::min(width, columns(front) + columns(cut));
  return out + (back.empty() ? "" : text(clip(back, std::max(left, context))));
}

}  // namespace

SharedEnds shared_ends(std::string_view one, std::string_view other) {
  const std::size_t most = std::min(one.size(), other.size());
  SharedEnds out;
  while (out.begin < most && one[out.begin] == other[out.begin]) ++out.begin;
  while (out.end < most - out.begin && one[one.size() - 1 - out.end] == other[other.size() - 1 - out.end])
    ++out.end;
  // Only whole characters are cut out.
  while (out.begin > 0 && out.begin < one.size() && is_utf8_continuation(one[out.begin])) --out.begin;
  while (out.end > 0 && is_utf8_continuation(one[one.size() - out.end])) --out.end;
  return out;
}

Difference difference(std::string_view before, std::string_view after, std::size_t width) {
  // Made printable first: nothing of it grows afterwards, and characters are whole.
  const std::string was = printable(before), is = printable(after);
  if (was == is) return {shown(was, {}, width), shown(is, {}, width)};
  const SharedEnds ends = shared_ends(was, is);
  // A character of the other text may end elsewhere; it begins where this one does.
  return {shown(was, ends, width), shown(is, ends, width)};
}

}  // namespace conform::reports::html
