// SPDX-License-Identifier: Apache-2.0
#include "base/shell_word.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"

namespace conform {
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

}  // namespace conform
