// SPDX-License-Identifier: Apache-2.0
#include "can/capture_marks.hpp"

#include <array>
#include <charconv>
#include <utility>

namespace conform::can {
namespace {

constexpr std::string_view introduction = "case ";

constexpr std::array<std::pair<CasePart, std::string_view>, 4> plain_parts{
    {{CasePart::preparation, " preparation"},
     {CasePart::begin, " begin"},
     {CasePart::end, " end"},
     {CasePart::putting_back, " putting back"}}};

constexpr std::array<std::pair<CasePart, std::string_view>, 2> numbered_parts{
    {{CasePart::step, " step "}, {CasePart::cleanup, " cleanup "}}};

/// "2" or "2: upload 1000h:00"
bool parse_number(std::string_view text, CaseMark& mark) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), mark.number);
  if (error != std::errc{} || mark.number == 0) return false;
  const auto rest = text.substr(static_cast<std::size_t>(end - text.data()));
  if (rest.empty()) return true;
  if (!rest.starts_with(": ")) return false;
  mark.words = rest.substr(2);
  return true;
}

}  // namespace

std::string to_comment(const CaseMark& mark) {
  std::string out = std::string(introduction) + mark.name;
  for (const auto& [part, word] : plain_parts) {
    if (part == mark.part) return out += word;
  }
  for (const auto& [part, word] : numbered_parts) {
    if (part == mark.part) out += std::string(word) + std::to_string(mark.number);
  }
  return mark.words.empty() ? out : out + ": " + mark.words;
}

std::optional<CaseMark> parse_case_mark(std::string_view text) {
  if (!text.starts_with(introduction)) return std::nullopt;
  text.remove_prefix(introduction.size());
  // The words of a step may hold anything, so its number comes first.
  for (const auto& [part, word] : numbered_parts) {
    CaseMark out;
    const auto at = text.find(word);
    if (at == std::string_view::npos || at == 0 || !parse_number(text.substr(at + word.size()), out))
      continue;
    out.name = text.substr(0, at);
    out.part = part;
    return out;
  }
  for (const auto& [part, word] : plain_parts) {
    if (!text.ends_with(word) || text.size() == word.size()) continue;
    return CaseMark{.name = std::string(text.substr(0, text.size() - word.size())), .part = part};
  }
  return std::nullopt;
}

std::vector<CaseMark> case_marks(std::string_view comment) {
  std::vector<CaseMark> out;
  while (!comment.empty()) {
    const auto end = comment.find(between_comments);
    if (auto mark = parse_case_mark(comment.substr(0, end))) out.push_back(std::move(*mark));
    if (end == std::string_view::npos) break;
    comment.remove_prefix(end + between_comments.size());
  }
  return out;
}

}  // namespace conform::can
