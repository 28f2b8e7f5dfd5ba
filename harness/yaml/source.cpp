// SPDX-License-Identifier: Apache-2.0
#include "yaml/source.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"

namespace conform::yaml {
namespace {

std::string normalise(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (!text.contains('\r')) return std::string(text);
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
    out.push_back(text[i]);
  }
  return out;
}

}  // namespace

std::string to_string(Position position) { return fmt::format("{}:{}", position.line, position.column); }

Source::Source(std::string name, std::string_view text) : name_(std::move(name)), text_(normalise(text)) {
  line_starts_.push_back(0);
  for (auto end = text_.find('\n'); end != std::string::npos && end + 1 < text_.size();
       end = text_.find('\n', end + 1))
    line_starts_.push_back(end + 1);
}

int Source::line_count() const { return text_.empty() ? 0 : static_cast<int>(line_starts_.size()); }

std::string_view Source::line(int number) const {
  if (number < 1 || number > line_count()) return {};
  const auto index = static_cast<std::size_t>(number - 1);
  const std::size_t begin = line_starts_[index];
  const std::size_t end = index + 1 < line_starts_.size() ? line_starts_[index + 1] : text_.size();
  auto out = std::string_view(text_).substr(begin, end - begin);
  if (out.ends_with('\n')) out.remove_suffix(1);
  return out;
}

Position Source::position(std::size_t offset) const {
  // The end of the file is shown behind its last line, not on a line that no editor numbers.
  offset = std::min(offset, text_.size() - (text_.ends_with('\n') ? 1 : 0));
  const auto next = std::ranges::upper_bound(line_starts_, offset);
  const auto index = static_cast<std::size_t>(next - line_starts_.begin()) - 1;
  const auto before = std::string_view(text_).substr(line_starts_[index], offset - line_starts_[index]);
  return {.line = static_cast<int>(index) + 1, .column = code_points(before) + 1};
}

std::size_t Source::offset(Position position) const {
  if (position.line < 1) return 0;
  if (position.line > line_count()) return text_.size();
  const std::string_view text = line(position.line);
  std::size_t at = 0;
  for (int column = 1; column < position.column && at < text.size(); ++column) {
    at += code_point_size(text.substr(at));
  }
  return line_starts_[static_cast<std::size_t>(position.line - 1)] + at;
}

SourcePtr make_source(std::string name, std::string_view text) {
  return std::make_shared<const Source>(std::move(name), text);
}

}  // namespace conform::yaml
