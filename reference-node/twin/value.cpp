// SPDX-License-Identifier: Apache-2.0
#include "twin/value.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <limits>
#include <utility>

#include "base/text.hpp"

namespace refnode {

namespace {

/// A whole number before its type is known.
struct WholeNumber {
  std::uint64_t magnitude = 0;
  bool negative = false;
  bool shows_bits = false;  ///< hexadecimal or octal: the highest bit may be a sign
};

/// The text before a comment, which the standard does not know and files have.
std::string_view without_remark(std::string_view text) {
  return conform::trim(text.substr(0, text.find_first_of(";#")));
}

bool same_letters(std::string_view text, std::string_view upper) {
  return std::ranges::equal(text, upper, [](char a, char b) {
    return (a >= 'a' && a <= 'z' ? static_cast<char>(a - 'a' + 'A') : a) == b;
  });
}

std::optional<std::uint64_t> digits(std::string_view text, int base) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool cut_prefix(std::string_view& text, std::string_view upper) {
  if (!same_letters(text.substr(0, upper.size()), upper)) return false;
  text.remove_prefix(upper.size());
  return true;
}

/// UL, LL and the like, as copied from a C program.
void cut_c_suffix(std::string_view& text) {
  for (int letters = 0; letters < 3 && !text.empty(); ++letters) {
    if (std::string_view("uUlL").find(text.back()) == std::string_view::npos) return;
    text.remove_suffix(1);
  }
}

/// Without sign: 17, 0x11, 021, 11h.
std::optional<WholeNumber> read_unsigned(std::string_view text) {
  WholeNumber out;
  std::optional<std::uint64_t> value;
  if (cut_prefix(text, "0X")) {
    out.shows_bits = true;
    cut_c_suffix(text);
    value = digits(text, 16);
  } else if (text.ends_with('h') || text.ends_with('H')) {
    out.shows_bits = true;
    value = digits(text.substr(0, text.size() - 1), 16);
  } else {
    cut_c_suffix(text);
    out.shows_bits = text.size() > 1 && text.front() == '0';
    value = digits(text, out.shows_bits ? 8 : 10);
  }
  if (!value) return std::nullopt;
  out.magnitude = *value;
  return out;
}

/// $NODEID once, and numbers, joined by '+'.
std::optional<WholeNumber> read_formula(std::string_view text, std::uint8_t node_id) {
  WholeNumber sum;
  bool seen = false;
  for (const auto part : conform::split(text, '+')) {
    const auto word = conform::trim(part);
    WholeNumber term;
    if (same_letters(word, "$NODEID")) {
      if (std::exchange(seen, true)) return std::nullopt;
      term.magnitude = node_id;
    } else if (const auto number = read_unsigned(word)) {
      term = *number;
    } else {
      return std::nullopt;
    }
    if (sum.magnitude > std::numeric_limits<std::uint64_t>::max() - term.magnitude) return std::nullopt;
    sum.magnitude += term.magnitude;
    sum.shows_bits = sum.shows_bits || term.shows_bits;
  }
  return seen ? std::optional(sum) : std::nullopt;
}

std::optional<WholeNumber> read_whole(std::string_view text, std::uint8_t node_id) {
  text = without_remark(text);
  if (text.find('$') != std::string_view::npos) return read_formula(text, node_id);
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text = conform::trim(text.substr(1));
  auto number = read_unsigned(text);
  if (number) number->negative = negative;
  return number;
}

/// Pairs of digits, blanks between them or not.
std::optional<Bytes> read_pairs(std::string_view text) {
  Bytes out;
  std::optional<unsigned> first;
  for (const char c : text) {
    if (c == ' ' || c == '\t') continue;
    const auto digit = digits({&c, 1}, 16);
    if (!digit) return std::nullopt;
    if (first) {
      out.push_back(static_cast<std::uint8_t>((*first << 4U) | *digit));
      first.reset();
    } else {
      first = static_cast<unsigned>(*digit);
    }
  }
  if (first) return std::nullopt;
  return out;
}

/// "365 43200000", days and milliseconds; six pairs of digits; or a number of 48 bits.
std::optional<Bytes> read_time(std::string_view text) {
  constexpr std::size_t size = 6;
  constexpr std::uint64_t most_milliseconds = 0x0FFF'FFFF;
  text = without_remark(text);
  if (const auto blank = text.find_first_of(" \t"); blank != std::string_view::npos) {
    const auto days = read_unsigned(text.substr(0, blank));
    const auto milliseconds = read_unsigned(conform::trim(text.substr(blank)));
    if (days && milliseconds) {
      if (days->magnitude > 0xFFFF || milliseconds->magnitude > most_milliseconds) return std::nullopt;
      return conform::to_le(milliseconds->magnitude | (days->magnitude << 32U), size);
    }
  }
  if (auto bytes = read_pairs(text); bytes && bytes->size() == size) return bytes;
  const auto number = read_unsigned(text);
  if (!number || (number->magnitude >> 48U) != 0) return std::nullopt;
  return conform::to_le(number->magnitude, size);
}

void put_unit(Bytes& out, std::uint32_t unit) {
  out.push_back(static_cast<std::uint8_t>(unit & 0xFFU));
  out.push_back(static_cast<std::uint8_t>((unit >> 8U) & 0xFFU));
}

/// The length of the UTF-8 character at the front and its code point; a byte that begins none stands for
/// itself.
std::pair<std::size_t, std::uint32_t> front_character(std::string_view text) {
  const auto byte = [&](std::size_t i) -> std::uint32_t { return static_cast<std::uint8_t>(text[i]); };
  const std::uint32_t lead = byte(0);
  const std::size_t size = lead >= 0xF0 && lead <= 0xF4 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC2 ? 2 : 1;
  if (size == 1 || lead > 0xF4 || text.size() < size) return {1, lead};
  std::uint32_t point = lead & (0xFFU >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return {1, lead};
    point = (point << 6U) | (byte(i) & 0x3FU);
  }
  if (point > 0x10FFFF) return {1, lead};
  return {size, point};
}

/// UNICODE_STRING: 16-bit characters, in the file as UTF-8.
Bytes read_unicode(std::string_view text) {
  Bytes out;
  while (!text.empty()) {
    const auto [size, point] = front_character(text);
    text.remove_prefix(size);
    if (point < 0x10000) {
      put_unit(out, point);
    } else {
      put_unit(out, 0xD800U + ((point - 0x10000U) >> 10U));
      put_unit(out, 0xDC00U + ((point - 0x10000U) & 0x3FFU));
    }
  }
  return out;
}

}  // namespace

std::optional<std::int64_t> read_integer(std::string_view text, DataType type, std::uint8_t node_id) {
  if (type == DataType::boolean) {
    const auto word = without_remark(text);
    if (same_letters(word, "TRUE")) return 1;
    if (same_letters(word, "FALSE")) return 0;
  }
  const auto number = read_whole(text, node_id);
  if (!number) return std::nullopt;
  const std::size_t bits = type == DataType::boolean ? 1 : fixed_size(type) * 8;
  const std::uint64_t all_ones = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  const std::uint64_t magnitude = number->magnitude;
  if (!is_signed_integer(type)) {
    if (magnitude > all_ones || (number->negative && magnitude != 0)) return std::nullopt;
    return static_cast<std::int64_t>(magnitude);
  }
  const std::uint64_t sign = std::uint64_t{1} << (bits - 1);
  if (number->negative) {
    if (magnitude > sign) return std::nullopt;
    return static_cast<std::int64_t>(~magnitude + 1);
  }
  if (magnitude < sign) return static_cast<std::int64_t>(magnitude);
  if (!number->shows_bits || magnitude > all_ones) return std::nullopt;
  return static_cast<std::int64_t>(magnitude | ~all_ones);
}

std::optional<double> read_real(std::string_view text, DataType type) {
  text = without_remark(text);
  const bool single = type == DataType::real32;
  if (cut_prefix(text, "0X")) {
    const auto bits = digits(text, 16);
    if (!bits || (single && (*bits >> 32U) != 0)) return std::nullopt;
    return single ? std::bit_cast<float>(static_cast<std::uint32_t>(*bits)) : std::bit_cast<double>(*bits);
  }
  if (text.starts_with('+')) text.remove_prefix(1);
  // Words as "inf" and "nan" are no numbers of a description.
  if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string_view::npos)
    return std::nullopt;
  const auto convert = [text]<typename Real>(Real value) -> std::optional<double> {
    const char* const begin = text.data();
    const char* const last = begin + text.size();
    const auto [end, error] = std::from_chars(begin, last, value);
    if (error != std::errc() || end != last) return std::nullopt;
    return value;
  };
  // In one step to the type itself: by way of a double a REAL32 could be rounded twice.
  return single ? convert(0.0F) : convert(0.0);
}

std::optional<Bytes> read_value(std::string_view text, DataType type, std::uint8_t node_id) {
  switch (type) {
    case DataType::visible_string: return Bytes(text.begin(), text.end());
    case DataType::unicode_string: return read_unicode(text);
    case DataType::octet_string:
    case DataType::domain: return read_pairs(text);
    case DataType::time_of_day:
    case DataType::time_difference: return read_time(text);
    case DataType::real32:
    case DataType::real64: {
      const auto value = read_real(text, type);
      if (!value) return std::nullopt;
      if (type == DataType::real64) return conform::to_le(std::bit_cast<std::uint64_t>(*value), 8);
      return conform::to_le(std::bit_cast<std::uint32_t>(static_cast<float>(*value)), 4);
    }
    default: break;
  }
  const auto value = read_integer(text, type, node_id);
  if (!value) return std::nullopt;
  return conform::to_le(static_cast<std::uint64_t>(*value), fixed_size(type));
}

}  // namespace refnode
