// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

namespace conform {
namespace {

constexpr int no_digit = -1;

// The <cctype> functions ask the locale; these do not.
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
constexpr char to_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

constexpr int hex_digit(char c) {
  if (is_digit(c)) return c - '0';
  const char low = to_lower(c);
  return low >= 'a' && low <= 'f' ? low - 'a' + 10 : no_digit;
}

/// Hexadecimal digits and nothing else, at most 64 bits.
std::optional<std::uint64_t> hex_value(std::string_view digits) {
  if (digits.empty() || digits.size() > 16) return std::nullopt;
  std::uint64_t value = 0;
  for (const char c : digits) {
    const int digit = hex_digit(c);
    if (digit == no_digit) return std::nullopt;
    value = value << 4U | static_cast<std::uint64_t>(digit);
  }
  return value;
}

/// Decimal digits and nothing else, at most 64 bits; leading zeros are the caller's business.
std::optional<std::uint64_t> decimal_value(std::string_view digits) {
  if (digits.empty()) return std::nullopt;
  constexpr auto max = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t value = 0;
  for (const char c : digits) {
    if (!is_digit(c)) return std::nullopt;
    const auto digit = static_cast<std::uint64_t>(c - '0');
    if (value > (max - digit) / 10U) return std::nullopt;
    value = value * 10U + digit;
  }
  return value;
}

/// Groups of exactly four digits with one space between them, as in "0609 0030".
std::optional<std::uint64_t> grouped_hex_value(std::string_view text) {
  std::string digits;
  for (const std::string_view group : split(text, ' ')) {
    if (group.size() != 4) return std::nullopt;
    digits += group;
  }
  return hex_value(digits);
}

std::optional<std::uint64_t> marked_hex_value(std::string_view text) {
  if (text.starts_with("0x")) return hex_value(text.substr(2));
  if (!text.ends_with('h')) return std::nullopt;
  text.remove_suffix(1);
  return text.find(' ') == std::string_view::npos ? hex_value(text) : grouped_hex_value(text);
}

/// `value` nanoseconds in `unit` with at most three decimals, or empty when that would lose something.
std::string in_unit(std::uint64_t value, std::uint64_t unit) {
  const std::uint64_t whole = value / unit;
  const std::uint64_t rest = value % unit;
  if (rest == 0) return fmt::format("{}", whole);
  if (unit < 1000 || rest % (unit / 1000) != 0) return {};
  std::string text = fmt::format("{}.{:03}", whole, rest / (unit / 1000));
  text.erase(text.find_last_not_of('0') + 1);
  return text;
}

}  // namespace

std::string hex(std::uint64_t value, int digits) {
  return fmt::format("{:0{}X}h", value, std::max(digits, 1));
}
std::string to_string(Index index) { return hex(index.value(), 4); }
std::string to_string(SubIndex sub) { return hex(sub.value(), 2); }
std::string to_string(Multiplexer mux) {
  return fmt::format("{:04X}h:{:02X}", mux.index.value(), mux.sub.value());
}
std::string to_string(AbortCode code) {
  return fmt::format("{:04X} {:04X}h", code.value() >> 16U, code.value() & 0xFFFFU);
}
std::string to_string(CanId id) {
  if (id.value() <= 0x7FF) return hex(id.value(), 3);
  return fmt::format("{:04X} {:04X}h", id.value() >> 16U, id.value() & 0xFFFFU);
}

std::string hex_bytes(ByteView bytes) {
  std::string out;
  for (const std::uint8_t byte : bytes) out += fmt::format("{}{:02X}", out.empty() ? "" : " ", byte);
  return out;
}

std::string to_string(Duration duration) {
  struct Unit {
    std::uint64_t nanoseconds;
    std::string_view name;
  };
  constexpr std::array<Unit, 4> units{{{1'000'000'000, "s"}, {1'000'000, "ms"}, {1'000, "us"}, {1, "ns"}}};
  const bool negative = duration.count() < 0;
  const auto bits = static_cast<std::uint64_t>(duration.count());
  const std::uint64_t magnitude = negative ? 0 - bits : bits;  // correct for the most negative count as well
  for (const Unit& unit : units) {
    if (magnitude != 0 && magnitude < unit.nanoseconds) continue;  // 100 ms, not 0.1 s
    const std::string number = in_unit(magnitude, unit.nanoseconds);
    if (!number.empty()) return fmt::format("{}{} {}", negative ? "-" : "", number, unit.name);
  }
  return {};  // not reached: nanoseconds are whole
}

std::optional<std::uint64_t> parse_number(std::string_view text) {
  if (text.starts_with("0x") || text.ends_with('h')) return marked_hex_value(text);
  if (text.size() > 1 && text.front() == '0') return std::nullopt;
  return decimal_value(text);
}

std::optional<NumberRange> parse_number_range(std::string_view text) {
  const auto dots = text.find("..");
  const auto low = parse_number(text.substr(0, dots));
  if (!low) return std::nullopt;
  if (dots == std::string_view::npos) return NumberRange{*low, *low};
  const auto upper = text.substr(dots + 2);
  if (upper.empty()) return NumberRange{*low, ~std::uint64_t{0}};
  const auto high = parse_number(upper);
  return high && *high >= *low ? std::optional(NumberRange{*low, *high}) : std::nullopt;
}

std::optional<Multiplexer> parse_multiplexer(std::string_view text) {
  const std::size_t colon = text.find(':');
  const auto index = marked_hex_value(text.substr(0, colon));
  if (!index || *index > 0xFFFF) return std::nullopt;
  std::uint64_t sub = 0;
  if (colon != std::string_view::npos) {
    const std::string_view rest = text.substr(colon + 1);
    const bool marked = rest.starts_with("0x") || rest.ends_with('h');
    const auto value = marked ? marked_hex_value(rest) : hex_value(rest);
    if (!value || *value > 0xFF) return std::nullopt;
    sub = *value;
  }
  return Multiplexer{Index{static_cast<std::uint16_t>(*index)}, SubIndex{static_cast<std::uint8_t>(sub)}};
}

std::optional<Duration> parse_duration(std::string_view text) {
  const std::size_t number_end = text.find_first_not_of("0123456789.");
  if (number_end == std::string_view::npos) return std::nullopt;
  const std::string_view number = text.substr(0, number_end);
  const std::string_view unit_name = trim(text.substr(number_end));
  std::uint64_t unit = 0;
  if (unit_name == "ns") unit = 1;
  if (unit_name == "us") unit = 1'000;
  if (unit_name == "ms") unit = 1'000'000;
  if (unit_name == "s") unit = 1'000'000'000;
  if (unit_name == "min") unit = 60'000'000'000;
  if (unit == 0) return std::nullopt;

  constexpr std::uint64_t limit = 24ULL * 3600 * 1'000'000'000;
  const std::size_t point = number.find('.');
  const auto whole = decimal_value(number.substr(0, point));
  if (!whole || *whole > limit / unit) return std::nullopt;
  std::uint64_t total = *whole * unit;
  if (point != std::string_view::npos) {
    const std::string_view decimals = number.substr(point + 1);
    const auto value = decimals.size() <= 9 ? decimal_value(decimals) : std::nullopt;
    if (!value) return std::nullopt;
    std::uint64_t scale = 1;
    for (std::size_t i = 0; i < decimals.size(); ++i) scale *= 10;
    // value < 1e9 and unit <= 6e10: the product is below 2^63. A fraction of a nanosecond cannot be kept.
    if (*value * unit % scale != 0) return std::nullopt;
    total += *value * unit / scale;
  }
  if (total > limit) return std::nullopt;
  return Duration{static_cast<Duration::rep>(total)};
}

std::optional<Bytes> parse_bytes(std::string_view text) {
  Bytes bytes;
  for (std::size_t i = 0; i < text.size();) {
    if (is_space(text[i])) {
      ++i;
      continue;
    }
    const auto byte = i + 1 < text.size() ? hex_value(text.substr(i, 2)) : std::nullopt;
    if (!byte) return std::nullopt;
    bytes.push_back(static_cast<std::uint8_t>(*byte));
    i += 2;
  }
  return bytes;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return parts;
    begin = end + 1;
  }
}

std::string join(std::span<const std::string> parts, std::string_view separator) {
  std::string out;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i != 0) out += separator;
    out += parts[i];
  }
  return out;
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(), to_lower);
  return out;
}

namespace {

/// Damerau-Levenshtein distance (optimal string alignment: one swap of neighbours counts one); any number
/// above `most` when it is above `most`.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t most) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  std::size_t least_before = 0;  // of the row `last`
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    std::size_t least = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
      least = std::min(least, row[j]);
    }
    // What follows is made of these two rows, and none of it becomes less; a swap adds one to the older of
    // them.
    if (least > most && least_before + 1 > most) return most + 1;
    least_before = least;
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

/// A code point and how many bytes it takes; zero bytes for anything that is not well-formed UTF-8.
struct Decoded {
  std::uint32_t code_point = 0;
  std::size_t size = 0;
};

Decoded decode_utf8(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
  };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return {};
  std::uint32_t code_point = lead & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code_point = code_point << 6U | (byte(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code_point >= 0xD800 && code_point <= 0xDFFF;
  if (code_point < smallest[size] || code_point > 0x10FFFF || surrogate) return {};
  return {code_point, size};
}

/// Characters that steer a terminal, reorder text or are not allowed in XML 1.0.
constexpr bool is_harmful(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7F && c <= 0x9F) || c == 0x061C || c == 0x200E || c == 0x200F ||
         (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069) || (c >= 0xFDD0 && c <= 0xFDEF) ||
         (c & 0xFFFEU) == 0xFFFE;
}

}  // namespace

std::size_t code_point_size(std::string_view text) {
  return std::max<std::size_t>(decode_utf8(text).size, 1);
}

int code_points(std::string_view text) {
  const auto wide = std::ranges::find_if(text, [](char c) { return static_cast<signed char>(c) < 0; });
  auto count = static_cast<int>(wide - text.begin());
  text.remove_prefix(static_cast<std::size_t>(count));
  for (; !text.empty(); text.remove_prefix(code_point_size(text))) ++count;
  return count;
}

std::string_view did_you_mean(std::string_view word, std::span<const std::string_view> candidates) {
  const std::string wanted = lower(word);
  std::string_view best;
  std::size_t best_distance = std::numeric_limits<std::size_t>::max();
  for (const std::string_view candidate : candidates) {
    // A third of the longer word may be wrong, at least one character; beyond that a guess only confuses.
    // Distances that the lengths alone rule out are not computed: the word may be anything the user typed.
    const std::size_t longer = std::max(word.size(), candidate.size());
    const std::size_t allowed = std::max<std::size_t>(longer, 3) / 3;
    if (longer - std::min(word.size(), candidate.size()) > allowed) continue;
    const std::size_t distance =
        edit_distance(wanted, lower(candidate), std::min(allowed, best_distance - 1));
    if (distance > allowed || distance >= best_distance) continue;
    if (distance == longer) continue;  // nothing in common
    best = candidate;
    best_distance = distance;
  }
  return best;
}

std::string printable(std::string_view text, bool keep_lines) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const Decoded decoded = decode_utf8(text);
    const std::size_t size = std::max<std::size_t>(decoded.size, 1);
    const bool kept_blank = keep_lines && (text.front() == '\n' || text.front() == '\t');
    if (kept_blank || (decoded.size != 0 && !is_harmful(decoded.code_point))) {
      out += text.substr(0, size);
    } else {
      for (const char c : text.substr(0, size))
        out += fmt::format("\\x{:02X}", static_cast<unsigned char>(c));
    }
    text.remove_prefix(size);
  }
  return out;
}

}  // namespace conform
