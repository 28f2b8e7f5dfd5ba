// SPDX-License-Identifier: Apache-2.0
#include "cli/run/command_line.hpp"

#include <algorithm>
#include <array>

#include "base/shell_word.hpp"
#include "reports/formats.hpp"

namespace conform::cli {
namespace {

/// "--junit" or "--junit=FILE".
bool says_where(std::string_view word) {
  if (!word.starts_with("--")) return false;
  const auto name = word.substr(2, word.find('=') == std::string_view::npos ? word.npos : word.find('=') - 2);
  constexpr std::array<std::string_view, 6> others{"bundle",  "sign",     "journal",
                                                   "capture", "captures", "candump"};
  return std::ranges::find(others, name) != others.end() || reports::find_format(name) != nullptr;
}

}  // namespace

std::string shell_line(std::span<char* const> arguments) {
  return shell_line(std::vector<std::string>(arguments.begin(), arguments.end()));
}

std::string shell_line(const std::vector<std::string>& arguments) {
  std::string out;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view word = arguments[i];
    if (says_where(word)) {
      if (!word.contains('=')) ++i;  // its value
      continue;
    }
    out += (out.empty() ? "" : " ") + shell_word(word);
  }
  return out;
}

}  // namespace conform::cli
