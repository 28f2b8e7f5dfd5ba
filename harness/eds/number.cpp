// SPDX-License-Identifier: Apache-2.0
#include "eds/number.hpp"

#include <charconv>
#include <limits>

#include "base/text.hpp"
#include "eds/ini_file.hpp"

namespace conform::eds {
namespace {

constexpr std::string_view node_id_word = "$NODEID";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::expected<std::uint64_t, NumberFault> digits(std::string_view text, int base) {
  if (text.empty()) return std::unexpected(NumberFault::not_a_number);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (end != text.data() + text.size()) return std::unexpected(NumberFault::not_a_number);
  if (error == std::errc::result_out_of_range) return std::unexpected(NumberFault::too_large);
  return value;
}

/// Cuts U, L, UL, LL or ULL off, in any case.
bool cut_suffix(std::string_view& text) {
  const auto digits_end = text.find_last_not_of("uUlL");
  if (digits_end == std::string_view::npos || text.size() - digits_end - 1 > 3) return false;
  const bool cut = digits_end + 1 != text.size();
  text = text.substr(0, digits_end + 1);
  return cut;
}

bool has_hex_prefix(std::string_view text) { return text.starts_with("0x") || text.starts_with("0X"); }

/// Digits without sign: 17, 0x11, 021, and 11h.
std::expected<Number, NumberFault> unsigned_number(std::string_view text) {
  Number out;
  if (has_hex_prefix(text)) {
    text.remove_prefix(2);
    out.base = NumberBase::hexadecimal;
    out.odd.c_suffix = cut_suffix(text);
    if (text.ends_with('h') || text.ends_with('H')) {
      text.remove_suffix(1);
      out.odd.trailing_h = true;
    }
    const auto value = digits(text, 16);
    if (!value) return std::unexpected(value.error());
    out.magnitude = *value;
    return out;
  }
  if (text.empty() || text.front() == '-') return std::unexpected(NumberFault::not_a_number);
  if (text.ends_with('h') || text.ends_with('H')) {
    text.remove_suffix(1);
    const auto value = digits(text, 16);
    if (!value) return std::unexpected(value.error());
    out.base = NumberBase::hexadecimal;
    out.odd.trailing_h = true;
    out.magnitude = *value;
    return out;
  }
  if (is_digit(text.front())) out.odd.c_suffix = cut_suffix(text);
  const auto value = digits(text, 10);
  if (!value) return std::unexpected(value.error());
  out.magnitude = *value;
  if (text.size() == 1 || text.front() != '0') return out;
  out.base = NumberBase::octal;
  if (text.find_first_of("89") != std::string_view::npos) return std::unexpected(NumberFault::bad_octal);
  const auto octal = digits(text, 8);
  if (!octal) return std::unexpected(octal.error());
  (*octal == *value ? out.odd.leading_zero : out.odd.octal) = true;
  out.magnitude = *octal;
  return out;
}

std::expected<Number, NumberFault> signed_number(std::string_view text) {
  const bool negative = text.starts_with('-');
  const bool plus = text.starts_with('+');
  if (negative || plus) text.remove_prefix(1);
  auto out = unsigned_number(trim(text));
  if (!out) return out;
  out->negative = negative && out->magnitude != 0;
  out->odd.plus_sign = plus;
  out->odd.negative_hex = negative && out->base == NumberBase::hexadecimal;
  return out;
}

/// $NODEID and numbers joined by '+', in any order.
std::expected<Number, NumberFault> formula(std::string_view text) {
  Number out;
  out.node_id = true;
  bool first = true;
  bool seen = false;
  bool offset_seen = false;
  for (const auto part : split(text, '+')) {
    const auto word = trim(part);
    if (word.size() != part.size()) out.odd.formula_blanks = true;
    if (same_word(word, node_id_word)) {
      if (seen) return std::unexpected(NumberFault::not_a_number);
      seen = true;
      out.odd.node_id_not_first = !first;
      out.odd.node_id_case = word != node_id_word;
    } else {
      const auto number = unsigned_number(word);
      if (!number) return number;
      if (out.magnitude > std::numeric_limits<std::uint64_t>::max() - number->magnitude)
        return std::unexpected(NumberFault::too_large);
      out.magnitude += number->magnitude;
      if (!offset_seen) out.base = number->base;
      offset_seen = true;
      out.odd.octal = out.odd.octal || number->odd.octal;
      out.odd.leading_zero = out.odd.leading_zero || number->odd.leading_zero;
      out.odd.trailing_h = out.odd.trailing_h || number->odd.trailing_h;
      out.odd.c_suffix = out.odd.c_suffix || number->odd.c_suffix;
    }
    first = false;
  }
  if (!seen) return std::unexpected(NumberFault::not_a_number);
  return out;
}

/// As the standard writes numbers, and most files: 17 or 0x11 of at most 64 bits, and nothing around it. All
/// else is looked at more closely.
std::optional<Number> plain_number(std::string_view text) {
  constexpr std::size_t most_decimal = 19, most_hexadecimal = 16;
  const bool hexadecimal = has_hex_prefix(text);
  if (hexadecimal) text.remove_prefix(2);
  if (text.empty() || text.size() > (hexadecimal ? most_hexadecimal : most_decimal)) return std::nullopt;
  if (!hexadecimal && text.size() > 1 && text.front() == '0') return std::nullopt;
  Number out;
  if (hexadecimal) out.base = NumberBase::hexadecimal;
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
    if (!is_digit(c) && !(letter && hexadecimal)) return std::nullopt;
    const auto digit = static_cast<std::uint64_t>(is_digit(c) ? c - '0' : (c | 0x20) - 'a' + 10);
    out.magnitude = out.magnitude * (hexadecimal ? 16U : 10U) + digit;
  }
  return out;
}

}  // namespace

std::string_view without_comment(std::string_view text) {
  return trim(text.substr(0, text.find_first_of(";#")));
}

std::expected<Number, NumberFault> parse_number(std::string_view text) {
  if (const auto plain = plain_number(text)) return *plain;
  text = trim(text);
  if (text.empty()) return std::unexpected(NumberFault::empty);
  const auto value = without_comment(text);
  if (value.empty()) return std::unexpected(NumberFault::not_a_number);
  auto out = value.find('$') != std::string_view::npos ? formula(value) : signed_number(value);
  if (out) out->odd.inline_comment = value.size() != text.size();
  return out;
}

std::optional<double> parse_real(std::string_view text) {
  text = trim(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  // from_chars also knows "inf" and "nan"; a default of that kind is no decimal number.
  if (text.find_first_not_of("0123456789+-.eE") != std::string_view::npos) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace conform::eds
