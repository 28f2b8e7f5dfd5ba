// SPDX-License-Identifier: Apache-2.0
#include "reports/markdown_text.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reports/text_tools.hpp"

namespace conform::reports {

std::string escaped(std::string_view text, std::size_t width) {
  constexpr std::string_view marks = "\\`*_{}[]>#!|~$";
  std::string out;
  for (const char c : clip(prose(text), width)) {
    if (c == '@') {
      out += "&#64;";  // a backslash does not keep a mention from notifying somebody
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      if (marks.find(c) != std::string_view::npos) out += '\\';
      out += c;
    }
  }
  return out;
}

std::string link_target(std::string_view path) {
  constexpr std::string_view plain = "-._~/";
  std::string out;
  for (const char c : path) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (letter || plain.contains(c)) {
      out += c;
    } else {
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return out;
}

std::string code(std::string_view text) {
  const std::string content = clip(log_safe(text), 400);
  std::size_t longest = 0;
  std::size_t run = 0;
  for (const char c : content) {
    run = c == '`' ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  const std::string fence(longest + 1, '`');
  std::string out = fence;
  const bool padded = content.empty() || content.starts_with('`') || content.ends_with('`');
  if (padded) out += ' ';
  out += content;
  if (padded) out += ' ';
  return out += fence;
}

}  // namespace conform::reports
