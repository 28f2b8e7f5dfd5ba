// SPDX-License-Identifier: Apache-2.0
// Plain scalars that YAML 1.1 readers, YAML 1.2 readers and people take for different things.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "yaml/loader.hpp"

namespace conform::yaml {
namespace {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

template <std::size_t size>
bool is_one_of(std::string_view text, const std::array<std::string_view, size>& words) {
  return std::ranges::find(words, text) != words.end();
}

/// Takes the leading characters for which `accept` holds.
template <typename Accept>
std::string_view take(std::string_view& text, Accept accept) {
  const auto end = std::ranges::find_if_not(text, accept);
  const auto out = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(out.size());
  return out;
}

bool take_char(std::string_view& text, std::string_view any_of) {
  if (text.empty() || !any_of.contains(text.front())) return false;
  text.remove_prefix(1);
  return true;
}

std::string_view without_sign(std::string_view text) {
  take_char(text, "+-");
  return text;
}

bool all(std::string_view text, std::string_view allowed) {
  return !text.empty() && text.find_first_not_of(allowed) == std::string_view::npos;
}

/// 010, 08, 00: octal in YAML 1.1 and C, decimal in YAML 1.2.
bool has_leading_zero(std::string_view text) {
  text = without_sign(text);
  return text.size() > 1 && text.front() == '0' && all(text, "0123456789_");
}

bool is_octal(std::string_view text) {
  text = without_sign(text);
  return text.starts_with("0o") && all(text.substr(2), "01234567");
}

bool is_binary(std::string_view text) {
  text = without_sign(text);
  return text.starts_with("0b") && all(text.substr(2), "01_");
}

bool has_underscore(std::string_view text) {
  text = without_sign(text);
  if (!text.contains('_')) return false;
  if (text.starts_with("0x")) return all(text.substr(2), "0123456789abcdefABCDEF_");
  return is_digit(text.front()) && all(text, "0123456789_.");
}

/// 12:30 is 750 in YAML 1.1.
bool is_sexagesimal(std::string_view text) {
  text = without_sign(text);
  if (take(text, is_digit).empty() || !text.starts_with(':')) return false;
  while (take_char(text, ":")) {
    const auto part = take(text, is_digit);
    if (part.empty() || part.size() > 2 || (part.size() == 2 && part.front() > '5')) return false;
  }
  if (take_char(text, ".")) take(text, is_digit);
  return text.empty();
}

/// 2.10, .5, 1., 1e3
bool is_float(std::string_view text) {
  text = without_sign(text);
  const bool whole = !take(text, is_digit).empty();
  const bool point = take_char(text, ".");
  const bool fraction = point && !take(text, is_digit).empty();
  if (!whole && !fraction) return false;
  bool exponent = false;
  if (take_char(text, "eE")) {
    take_char(text, "+-");
    exponent = !take(text, is_digit).empty();
    if (!exponent) return false;
  }
  return text.empty() && (point || exponent);
}

/// 2024-01-31: a time stamp in YAML 1.1.
bool is_date(std::string_view text) {
  if (take(text, is_digit).size() != 4 || !take_char(text, "-")) return false;
  const auto month = take(text, is_digit).size();
  if (month < 1 || month > 2 || !take_char(text, "-")) return false;
  const auto day = take(text, is_digit).size();
  return day >= 1 && day <= 2 && text.empty();
}

}  // namespace

bool check_plain(const Node& scalar, Diagnostics& diagnostics) {
  if (!scalar.plain()) return true;
  static constexpr std::array<std::string_view, 16> words = {
      "y", "Y", "yes", "Yes", "YES", "n", "N", "no", "No", "NO", "on", "On", "ON", "off", "Off", "OFF"};
  static constexpr std::array<std::string_view, 4> booleans = {"True", "TRUE", "False", "FALSE"};
  static constexpr std::array<std::string_view, 12> not_finite = {
      ".inf", ".Inf", ".INF", "-.inf", "-.Inf", "-.INF", "+.inf", "+.Inf", "+.INF", ".nan", ".NaN", ".NAN"};

  const std::string& text = scalar.text();
  const auto ambiguous = [&](std::string_view meaning, std::string hint) {
    diagnostics.error(scalar, fmt::format("'{}' is ambiguous in YAML: {}", text, meaning), std::move(hint));
    return false;
  };
  // Of most scalars nothing is said.
  const auto quote = [&text] { return fmt::format("quote it: \"{}\"", text); };

  if (is_one_of(text, words)) {
    return ambiguous("some readers take it for a boolean", quote() + ", or write true or false");
  }
  if (is_one_of(text, booleans))
    return ambiguous("only some readers take it for a boolean", "write it in lower case, or " + quote());
  if (is_one_of(text, not_finite)) return ambiguous("readers take it for a floating-point number", quote());
  if (text.empty() || !(is_digit(text.front()) || std::string_view("+-.").contains(text.front())))
    return true;

  if (has_leading_zero(text)) {
    return ambiguous("with its leading zero some readers take it for octal",
                     fmt::format("drop the zero, write hex as {}h, or {}", text, quote()));
  }
  if (is_octal(text))
    return ambiguous("only some readers take it for an octal number",
                     "write it in decimal or hex, or " + quote());
  if (is_binary(text))
    return ambiguous("only some readers take it for a binary number",
                     "write it in decimal or hex, or " + quote());
  if (has_underscore(text))
    return ambiguous("some readers skip the underscore", "leave it out, or " + quote());
  if (is_sexagesimal(text)) {
    return ambiguous("some readers take it for a number to base 60",
                     "write the index as hex (1003h:00), or " + quote());
  }
  if (is_float(text)) return ambiguous("readers take it for a floating-point number", quote());
  if (is_date(text)) return ambiguous("some readers take it for a date", quote());
  return true;
}

}  // namespace conform::yaml
