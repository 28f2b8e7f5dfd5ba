// SPDX-License-Identifier: Apache-2.0
#include "yaml/diagnostic.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/excerpt.hpp"
#include "base/text.hpp"
#include "yaml/node.hpp"

namespace conform::yaml {

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
    const auto shown = excerpt(
        source_->line(diagnostic.begin.line),
        source_->offset(diagnostic.begin) - source_->offset({diagnostic.begin.line, 1}), diagnostic.length);
    out += to_lines(shown, diagnostic.begin.line, tint, off);
  }
  if (left_out_ > 0) out += fmt::format("{}: {} more not shown\n", printable(source_->name()), left_out_);
  return out;
}

std::string suggestion(std::string_view word, const std::vector<std::string_view>& known) {
  const auto near = did_you_mean(word, known);
  return near.empty() ? std::string() : fmt::format("did you mean '{}'?", near);
}

}  // namespace conform::yaml
