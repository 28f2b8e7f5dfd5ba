// SPDX-License-Identifier: Apache-2.0
// Everything a tree says of itself, as text.
#pragma once

#include <string>

#include <fmt/format.h>

#include "yaml/node.hpp"

enum class Blanks { shown, left_out };

/// One line for each value: its kind and style, its place and length, its text, and where each byte of it
/// stands. Without blanks: of the text only what is none, and not where it stands.
inline std::string dump(const conform::yaml::Node& node, Blanks blanks = Blanks::shown, int depth = 0) {
  using Kind = conform::yaml::Node::Kind;
  const auto where = node.position();
  auto out = fmt::format("{:{}}{}{}{}{}{} {}:{}+{}", "", 2 * depth, node.kind() == Kind::null ? "null" : "",
                         node.quoted() ? "'" : "", node.block_scalar() ? "|" : "", node.folded() ? ">" : "",
                         node.flow() ? "[" : "", where.line, where.column, node.length());
  if (node.is_scalar()) {
    auto text = node.text();
    if (blanks == Blanks::left_out)
      std::erase_if(text, [](char c) { return c == ' ' || c == '\n' || c == '\t'; });
    out += fmt::format(" '{}'", text);
    for (std::size_t i = 0; blanks == Blanks::shown && i < node.text().size(); ++i) {
      const auto at = node.position_at(i);
      out += fmt::format(" {}:{}", at.line, at.column);
    }
  }
  out += '\n';
  for (const auto& item : node.items()) out += "- " + dump(item, blanks, depth + 1);
  for (const auto& entry : node.entries())
    out += dump(entry.key, blanks, depth + 1) + ": " + dump(entry.value, blanks, depth + 2);
  return out;
}
