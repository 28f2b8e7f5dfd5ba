// SPDX-License-Identifier: Apache-2.0
#include "usage/roff.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "base/text.hpp"

namespace conform::usage {
namespace {

std::string escaped(std::string_view text, bool typed) {
  std::string out;
  while (!text.empty()) {
    const auto size = code_point_size(text);
    if (size > 1) {
      auto code = static_cast<std::uint32_t>(static_cast<unsigned char>(text[0]) & (0xFFU >> (size + 1)));
      for (std::size_t i = 1; i < size; ++i)
        code = code << 6U | (static_cast<unsigned char>(text[i]) & 0x3FU);
      out += fmt::format("\\[u{:04X}]", code);
      text.remove_prefix(size);
      continue;
    }
    const char c = text.front();
    text.remove_prefix(1);
    switch (c) {
      case '\\': out += "\\e"; break;
      case '-': out += typed ? "\\-" : "-"; break;
      case '\'': out += "\\(aq"; break;
      case '"': out += "\\(dq"; break;
      case '`': out += "\\(ga"; break;
      case '^': out += "\\(ha"; break;
      case '~': out += "\\(ti"; break;
      default: out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

/// A full stop at the beginning of a line makes a request of it.
std::string no_request(const std::string& text) { return text.starts_with('.') ? "\\&" + text : text; }

/// Options in a sentence are typed, too: "--allow".
std::string with_options(std::string_view text) {
  std::string out;
  bool first = true;
  for (const auto word : split(text, ' ')) {
    const auto dash = word.find_first_not_of("('");
    const bool option = dash != std::string_view::npos && word[dash] == '-' && word.size() > dash + 1;
    out += (first ? "" : " ") + escaped(word, option);
    first = false;
  }
  return out;
}

}  // namespace

std::string roff_text(std::string_view text) { return no_request(with_options(text)); }
std::string roff_literal(std::string_view text) { return no_request(escaped(text, true)); }

}  // namespace conform::usage
