// SPDX-License-Identifier: Apache-2.0
#include "yaml/diagnostic.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/text.hpp"
#include "yaml/node.hpp"

namespace conform::yaml {
namespace {

constexpr int window = 100;      // columns of a source line that are shown
constexpr int window_lead = 40;  // of these before the caret, when the line is clipped on the left
constexpr int tab_width = 4;

/// A source line as it is printed, and where in it the marked characters are.
struct Excerpt {
  std::string text;
  std::string underline;
};

/// One code point after the other through printable(), because escapes are wider than what they stand for.
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

}  // namespace

Diagnostics::Diagnostics(SourcePtr source) : source_(std::move(source)) { CONFORM_CHECK(source_ != nullptr); }

void Diagnostics::add(Diagnostic diagnostic) {
  const auto place = std::ranges::upper_bound(all_, diagnostic.begin, {}, &Diagnostic::begin);
  for (auto it = place; it != all_.begin() && std::prev(it)->begin == diagnostic.begin; --it) {
    if (std::prev(it)->message == diagnostic.message) return;
  }
  if (diagnostic.severity == Diagnostic::Severity::error) ++errors_;
  if (all_.size() >= limit) {
    ++left_out_;
    return;
  }
  all_.insert(place, std::move(diagnostic));
}

void Diagnostics::error(Position begin, int length, std::string message, std::string hint) {
  add({Diagnostic::Severity::error, begin, length, std::move(message), std::move(hint)});
}

void Diagnostics::warning(Position begin, int length, std::string message, std::string hint) {
  add({Diagnostic::Severity::warning, begin, length, std::move(message), std::move(hint)});
}

void Diagnostics::error(const Node& node, std::string message, std::string hint) {
  error(node.position(), node.length(), std::move(message), std::move(hint));
}

void Diagnostics::warning(const Node& node, std::string message, std::string hint) {
  warning(node.position(), node.length(), std::move(message), std::move(hint));
}

std::string Diagnostics::render(bool colour) const {
  const std::string_view off = colour ? "\x1b[0m" : "";
  const std::string_view bold = colour ? "\x1b[1m" : "";
  std::string out;
  for (const auto& diagnostic : all_) {
    const bool is_error = diagnostic.severity == Diagnostic::Severity::error;
    const std::string_view tint = !colour ? "" : is_error ? "\x1b[1;31m" : "\x1b[1;33m";
    out += fmt::format("{}{}:{}:{} {}{}:{} {}{}{}{}{}\n", bold, printable(source_->name()),
                       to_string(diagnostic.begin), off, tint, is_error ? "error" : "warning", off, bold,
                       printable(diagnostic.message), diagnostic.hint.empty() ? "" : "; ",
                       printable(diagnostic.hint), off);
    if (diagnostic.begin.line > source_->line_count()) continue;
    const auto shown =
        excerpt(source_->line(diagnostic.begin.line), diagnostic.begin.column, diagnostic.length);
    const std::string text = shown.text.empty() ? "" : " " + shown.text;
    out += fmt::format("{:5} |{}\n      | {}{}{}\n", diagnostic.begin.line, text, tint, shown.underline, off);
  }
  if (left_out_ > 0) out += fmt::format("{}: {} more not shown\n", printable(source_->name()), left_out_);
  return out;
}

std::string suggestion(std::string_view word, const std::vector<std::string_view>& known) {
  const auto near = did_you_mean(word, known);
  return near.empty() ? std::string() : fmt::format("did you mean '{}'?", near);
}

}  // namespace conform::yaml
