// SPDX-License-Identifier: Apache-2.0
#include "steps/tokens.hpp"

#include <algorithm>

namespace conform::steps {
namespace {

bool is_hex_digits(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'F') || (c >= 'a' && c <= 'f');
  });
}

bool is_word_character(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$' ||
         c == ':' || c == '.' || c == '-' || c == '#';
}

}  // namespace

Result<std::vector<Token>> tokenize(std::string_view text) {
  // The parsers recurse for every parenthesis and 'not': a bound on the text is a bound on the stack.
  constexpr std::size_t longest = 1000;
  if (text.size() > longest)
    return fail("a text of " + std::to_string(text.size()) + " characters", {}, "write at most 1000");
  std::vector<Token> out;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == ' ' || c == '\t' || c == '\n') {
      ++i;
      continue;
    }
    if (is_word_character(c)) {
      std::size_t end = i;
      while (end < text.size() && is_word_character(text[end])) {
        // "1..240" is three tokens, "device.yaml" and "$profile.store_timeout" one.
        if (text[end] == '.' && end + 1 < text.size() && text[end + 1] == '.') break;
        ++end;
      }
      if (end == i) {  // it begins with ".."
        out.push_back({"..", i});
        i += 2;
        continue;
      }
      out.push_back({std::string(text.substr(i, end - i)), i});
      i = end;
      continue;
    }
    static constexpr std::string_view two[] = {">=", "<=", "+-"};
    const auto pair = text.substr(i, 2);
    if (std::ranges::find(two, pair) != std::end(two)) {
      out.push_back({std::string(pair), i});
      i += 2;
    } else if (std::string_view("+|&^~()<>=,%*").find(c) != std::string_view::npos) {
      out.push_back({std::string(1, c), i});
      ++i;
    } else {
      return fail("unexpected character '" + std::string(1, c) + "'", {}, "in '" + std::string(text) + "'");
    }
  }
  // "0609 0030h", "8000 06A0h", "2710 016E 3600h": groups of four hex digits, the last one with h.
  const auto is_group = [&out](std::size_t i) {
    return i < out.size() && out[i].text.size() == 4 && is_hex_digits(out[i].text);
  };
  const auto ends_number = [&out](std::size_t i) {
    return i < out.size() && out[i].text.size() == 5 && out[i].text.back() == 'h' &&
           is_hex_digits(std::string_view(out[i].text).substr(0, 4));
  };
  std::vector<Token> joined;
  for (std::size_t i = 0; i < out.size(); ++i) {
    std::size_t last = i;
    while (last < i + 3 && is_group(last)) ++last;
    joined.push_back(out[i]);
    if (last == i || !ends_number(last)) continue;
    while (i < last) joined.back().text += out[++i].text;
  }
  return joined;
}

}  // namespace conform::steps
