// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/line_diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/text.hpp"
#include "eds/text_lines.hpp"

namespace conform::cli {
namespace {

/// With its end, so that another end of line is a change.
std::vector<std::string_view> lines_of(std::string_view text) {
  const eds::TextLines lines(text);
  std::vector<std::string_view> out;
  std::size_t begin = 0;
  for (std::size_t number = 1; number <= lines.count(); ++number) {
    const auto end = lines.start(number + 1);
    out.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return out;
}

/// Lines [old_begin, old_end) became [new_begin, new_end).
struct Change {
  std::size_t old_begin, old_end, new_begin, new_end;
};

using Text = std::vector<std::string_view>;

/// The nearest place behind a difference at which both go on alike; nothing is moved by our changes.
Change next_change(const Text& before, const Text& after, std::size_t i, std::size_t j) {
  constexpr std::size_t farthest = 400;
  // Lines that were replaced one by one are followed by one that is the same; where some came or went, a
  // blank line or a bracket is too little.
  const auto alike = [&](std::size_t a, std::size_t b) {
    if (a >= before.size() || b >= after.size()) return a == before.size() && b == after.size();
    if (before[a] != after[b]) return false;
    return a - i == b - j || a + 1 >= before.size() || b + 1 >= after.size() || before[a + 1] == after[b + 1];
  };
  for (std::size_t distance = 1; distance <= farthest; ++distance) {
    for (std::size_t added = 0; added <= distance; ++added) {
      const auto a = i + distance - added;
      const auto b = j + added;
      if (a <= before.size() && b <= after.size() && alike(a, b)) return {i, a, j, b};
    }
  }
  return {i, before.size(), j, after.size()};
}

std::vector<Change> changes(const Text& before, const Text& after) {
  std::vector<Change> out;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < before.size() || j < after.size()) {
    if (i < before.size() && j < after.size() && before[i] == after[j]) {
      ++i;
      ++j;
      continue;
    }
    out.push_back(next_change(before, after, i, j));
    i = out.back().old_end;
    j = out.back().new_end;
  }
  return out;
}

constexpr std::size_t context = 3;

}  // namespace

std::string line_diff(std::string_view before, std::string_view after, std::string_view name, bool colour) {
  const auto old_lines = lines_of(before);
  const auto new_lines = lines_of(after);
  const auto all = changes(old_lines, new_lines);
  if (all.empty()) return {};
  const std::string_view off = colour ? "\x1b[0m" : "";
  const auto line = [&](char sign, std::string_view text) {
    while (text.ends_with('\n') || text.ends_with('\r')) text.remove_suffix(1);
    const std::string_view tint = !colour || sign == ' ' ? "" : sign == '+' ? "\x1b[32m" : "\x1b[31m";
    return fmt::format("{}{}{}{}\n", tint, sign, printable(text), tint.empty() ? "" : off);
  };
  std::string out = fmt::format("--- {0}\n+++ {0}\n", printable(name));
  for (std::size_t first = 0; first < all.size();) {
    auto last = first;
    while (last + 1 < all.size() && all[last + 1].old_begin - all[last].old_end <= 2 * context) ++last;
    const auto lead = std::min(context, all[first].old_begin);
    const auto tail = std::min(context, old_lines.size() - all[last].old_end);
    const auto begin = all[first].old_begin - lead;
    const auto end = all[last].old_end + tail;
    const auto new_begin = all[first].new_begin - lead;
    const auto new_end = all[last].new_end + tail;
    out += fmt::format("@@ -{},{} +{},{} @@\n", begin + 1, end - begin, new_begin + 1, new_end - new_begin);
    auto at = begin;
    for (auto each = first; each <= last; ++each) {
      for (; at < all[each].old_begin; ++at) out += line(' ', old_lines[at]);
      for (; at < all[each].old_end; ++at) out += line('-', old_lines[at]);
      for (auto added = all[each].new_begin; added < all[each].new_end; ++added)
        out += line('+', new_lines[added]);
    }
    for (; at < end; ++at) out += line(' ', old_lines[at]);
    first = last + 1;
  }
  return out;
}

}  // namespace conform::cli
