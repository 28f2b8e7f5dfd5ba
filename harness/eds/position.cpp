// SPDX-License-Identifier: Apache-2.0
#include "eds/position.hpp"

namespace conform::eds {

std::string to_string(Position position) {
  if (!position.known()) return {};
  return std::to_string(position.line) + ":" + std::to_string(position.column);
}

void Remarks::add(Deviation what, Position at, std::string_view detail, Position first, std::size_t most) {
  const auto kind = static_cast<std::size_t>(what);
  if (counts_.size() <= kind) counts_.resize(kind + 1);
  if (++counts_[kind] > most_of_a_kind) {
    ++left_out_;
    return;
  }
  all_.push_back({what, at, shortened(detail, most), first});
}

std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  return std::string(text.substr(0, most)) + "...";
}

}  // namespace conform::eds
