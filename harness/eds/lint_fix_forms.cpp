// SPDX-License-Identifier: Apache-2.0
#include "eds/lint_fix_forms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <vector>

#include "base/text.hpp"
#include "eds/ini_file.hpp"
#include "eds/number.hpp"

namespace conform::eds {
namespace {

std::optional<unsigned> decimal(std::string_view text) {
  unsigned out = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return out;
}

bool is_hex(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
}

}  // namespace

std::optional<std::string> standard_date(std::string_view text) {
  const auto separator = text.find_first_of("-./");
  if (separator == std::string_view::npos) return std::nullopt;
  const auto parts = split(text, text[separator]);
  if (parts.size() != 3) return std::nullopt;
  const auto first = decimal(parts[0]);
  const auto second = decimal(parts[1]);
  const auto third = decimal(parts[2]);
  if (!first || !second || !third) return std::nullopt;
  unsigned month = *first;
  unsigned day = *second;
  unsigned year = *third;
  if (parts[0].size() == 4) {  // 2024-03-31
    year = *first;
    month = *second;
    day = *third;
  } else if (parts[2].size() != 4) {
    return std::nullopt;
  } else if (month > 12 && day <= 12) {  // 31.03.2024
    std::swap(month, day);
  } else if (text[separator] != '-' && month <= 12 && day <= 12 && month != day) {
    return std::nullopt;  // 03.04.2024 is in April or in March, by the country
  }
  if (month < 1 || month > 12 || day < 1 || day > 31) return std::nullopt;
  return fmt::format("{:02}-{:02}-{:04}", month, day, year);
}

std::optional<std::string> standard_time(std::string_view text) {
  text = trim(text);
  const auto last_digit = text.find_last_of("0123456789");
  if (last_digit == std::string_view::npos) return std::nullopt;
  auto half = lower(trim(text.substr(last_digit + 1)));
  std::erase(half, '.');
  if (!half.empty() && half != "am" && half != "pm") return std::nullopt;
  const auto parts = split(text.substr(0, last_digit + 1), ':');
  if (parts.size() != 2 && parts.size() != 3) return std::nullopt;
  for (const auto part : parts) {
    if (part.size() > 2 || !decimal(part)) return std::nullopt;
  }
  auto hour = *decimal(parts[0]);
  const auto minute = *decimal(parts[1]);
  if (parts[1].size() != 2 || minute > 59 || hour > 23) return std::nullopt;
  if (half == "am" && hour > 12) return std::nullopt;
  const bool afternoon = half == "pm" || (half.empty() && hour >= 12);
  hour %= 12;
  return fmt::format("{:02}:{:02}{}", hour == 0 ? 12 : hour, minute, afternoon ? "PM" : "AM");
}

std::optional<std::string> standard_formula(std::string_view text) {
  const auto number = parse_number(text);
  if (!number || !number->node_id || number->odd.inline_comment) return std::nullopt;
  std::string out = "$NODEID";
  for (const auto part : split(text, '+')) {
    if (!same_word(trim(part), "$NODEID")) out += fmt::format("+{}", trim(part));
  }
  return out;
}

std::optional<std::string> standard_number(std::string_view text) {
  const auto number = parse_number(text);
  if (!number || number->node_id || number->odd.inline_comment) return std::nullopt;
  if (text.starts_with('+')) text = trim(text.substr(1));
  const bool negative = text.starts_with('-');
  if (negative) text = trim(text.substr(1));
  const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
  std::string out(text);
  if (number->odd.c_suffix) out.resize(out.find_last_not_of("uUlL") + 1);
  if (number->odd.trailing_h) {
    out.pop_back();
    if (!hexadecimal) {
      if (!is_hex(out)) return std::nullopt;
      out.insert(0, "0x");
    }
  }
  return (negative ? "-" : "") + out;
}

std::string number_like(std::string_view like, std::size_t number) {
  if (!like.starts_with("0x") && !like.starts_with("0X")) return std::to_string(number);
  return fmt::format("{}{:0{}X}", like.substr(0, 2), number, like.size() - 2);
}

}  // namespace conform::eds
