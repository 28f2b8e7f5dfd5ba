// SPDX-License-Identifier: Apache-2.0
#include "cli/run/command_line.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/formats.hpp"

namespace conform::cli {
namespace {

bool is_plain(char c) {
  constexpr std::string_view others = "_-./:=,@%+";
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         others.find(c) != std::string_view::npos;
}

/// Every byte that is not plain by its number: it survives a terminal, a mail and a text file.
std::string escaped_word(std::string_view argument) {
  std::string out = "$'";
  for (const char c : argument) {
    if (is_plain(c) || c == ' ') {
      out += c;
    } else {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
  }
  return out + "'";
}

/// "--junit" or "--junit=FILE".
bool says_where(std::string_view word) {
  if (!word.starts_with("--")) return false;
  const auto name = word.substr(2, word.find('=') == std::string_view::npos ? word.npos : word.find('=') - 2);
  constexpr std::array<std::string_view, 6> others{"bundle",  "sign",     "journal",
                                                   "capture", "captures", "candump"};
  return std::ranges::find(others, name) != others.end() || reports::find_format(name) != nullptr;
}

}  // namespace

std::string shell_word(std::string_view argument) {
  if (!argument.empty() && std::ranges::all_of(argument, is_plain)) return std::string(argument);
  // What has to be made printable would not come back from a report as it was.
  if (printable(argument) != argument) return escaped_word(argument);
  std::string out = "'";
  for (const char c : argument) {
    if (c == '\'') {
      out += "'\\''";
    } else {
      out += c;
    }
  }
  return out + "'";
}

std::string shell_line(std::span<char* const> arguments) {
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
