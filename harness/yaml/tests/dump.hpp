// SPDX-License-Identifier: Apache-2.0
// Everything a tree says of itself, as text.
#pragma once

#include <string>

#include <fmt/format.h>

#include "yaml/node.hpp"

enum class Folded { shown, left_out };

/// One line for each value: its kind and style, its place and length, where its text stands, the text.
inline std::string dump(const conform::yaml::Node& node, Folded folded = Folded::shown, int depth = 0) {
  using Kind = conform::yaml::Node::Kind;
  const auto where = node.position();
  auto out = fmt::format("{:{}}{}{}{}{}{} {}:{}+{}", "", 2 * depth, node.kind() == Kind::null ? "null" : "",
                         node.quoted() ? "'" : "", node.block_scalar() ? "|" : "", node.folded() ? ">" : "",
                         node.flow() ? "[" : "", where.line, where.column, node.length());
  if (node.is_scalar() && !(node.folded() && folded == Folded::left_out)) {
    out += fmt::format(" '{}'", node.text());
    for (std::size_t i = 0; i < node.text().size(); ++i) {
      const auto at = node.position_at(i);
      out += fmt::format(" {}:{}", at.line, at.column);
    }
  }
  out += '\n';
  for (const auto& item : node.items()) out += "- " + dump(item, folded, depth + 1);
  for (const auto& entry : node.entries())
    out += dump(entry.key, folded, depth + 1) + ": " + dump(entry.value, folded, depth + 2);
  return out;
}
