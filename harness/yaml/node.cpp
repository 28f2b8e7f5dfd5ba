// SPDX-License-Identifier: Apache-2.0
#include "yaml/node.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"

namespace conform::yaml {

const Node* Node::find(std::string_view key) const {
  const auto found =
      std::ranges::find_if(entries_, [&](const Entry& entry) { return entry.key.text() == key; });
  return found == entries_.end() ? nullptr : &found->value;
}

Position Node::line_position(int line) const {
  if (!lines_.empty() && line >= 0) {
    return lines_[std::min(static_cast<std::size_t>(line), lines_.size() - 1)];
  }
  return {.line = position_.line, .column = position_.column + (quoted_ ? 1 : 0)};
}

Position Node::position_at(std::size_t offset) const {
  const auto before = std::string_view(text_).substr(0, offset);
  if (block_scalar_) {
    const auto line = std::ranges::count(before, '\n');
    auto out = line_position(static_cast<int>(line));
    const auto newline = before.rfind('\n');
    out.column += code_points(newline == std::string_view::npos ? before : before.substr(newline + 1));
    return out;
  }
  auto out = line_position(0);
  if (verbatim_) out.column += code_points(before);
  return out;
}

std::string describe(const Node& node) {
  switch (node.kind()) {
    case Node::Kind::null: return "nothing";
    case Node::Kind::sequence: return "a list";
    case Node::Kind::mapping: return "a mapping";
    case Node::Kind::scalar: break;
  }
  constexpr std::size_t shown = 40;
  if (node.text().size() <= shown) return fmt::format("'{}'", node.text());
  // Not in the middle of a character.
  std::size_t end = shown;
  while (end > 0 && (static_cast<unsigned char>(node.text()[end]) & 0xC0U) == 0x80U) --end;
  return fmt::format("'{}...'", node.text().substr(0, end));
}

}  // namespace conform::yaml
