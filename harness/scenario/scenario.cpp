// SPDX-License-Identifier: Apache-2.0
#include "scenario/scenario.hpp"

#include <array>

namespace conform::scenario {
namespace {
constexpr std::array<std::string_view, 4> words = {"read-only", "config", "nvm", "motion"};
}

std::string_view to_string(Risk risk) { return words[static_cast<std::size_t>(risk)]; }

std::optional<Risk> parse_risk(std::string_view word) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == word) return static_cast<Risk>(i);
  }
  return std::nullopt;
}

}  // namespace conform::scenario
