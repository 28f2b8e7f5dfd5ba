// SPDX-License-Identifier: Apache-2.0
// The notation of the field, written and read: 1003h, 0609 0030h, 100 ms, bytes as "2F 03 10 00".
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "base/time.hpp"

namespace conform {

/// Upper-case hex with at least `digits` digits and the suffix h: hex(0x1F, 2) = "1Fh".
[[nodiscard]] std::string hex(std::uint64_t value, int digits);
/// "1003h", "00h", "1003h:00"
[[nodiscard]] std::string to_string(Index index);
[[nodiscard]] std::string to_string(SubIndex sub);
[[nodiscard]] std::string to_string(Multiplexer mux);
/// "0609 0030h"
[[nodiscard]] std::string to_string(AbortCode code);
/// "6A0h" (11 bit) or "0000 06A0h" when above 7FFh
[[nodiscard]] std::string to_string(CanId id);
/// Bytes in transmission order: "2F 03 10 00".
[[nodiscard]] std::string hex_bytes(ByteView bytes);
/// "250 us", "100 ms", "1.5 s": the largest unit that needs at most three decimals.
[[nodiscard]] std::string to_string(Duration duration);

/// Unsigned number in one of our forms: "17", "1Fh", "0x1F", "0609 0030h". A leading zero without h or 0x,
/// signs, underscores and anything else are refused (nullopt): YAML readers disagree on them.
[[nodiscard]] std::optional<std::uint64_t> parse_number(std::string_view text);
/// Both ends belong to it.
struct NumberRange {
  std::uint64_t low = 0, high = 0;
  [[nodiscard]] constexpr bool holds(std::uint64_t value) const { return value >= low && value <= high; }
};
/// "2000h..5FFFh", "4" (from 4 to 4), "15.." (no upper end), never downwards; the numbers as in parse_number.
[[nodiscard]] std::optional<NumberRange> parse_number_range(std::string_view text);
/// "1003h:00", "1003h" (sub-index 00h), "0x1003:0x00"; the sub-index is hexadecimal with or without h.
[[nodiscard]] std::optional<Multiplexer> parse_multiplexer(std::string_view text);
/// "100 ms", "1 s", "1.5 s", "250 us", "2 min": a unit is mandatory, up to nine decimals, at most 24 h.
[[nodiscard]] std::optional<Duration> parse_duration(std::string_view text);
/// "2F 03 10 00", "2F031000"; nullopt when not made of whole bytes.
[[nodiscard]] std::optional<Bytes> parse_bytes(std::string_view text);

/// Whether a byte continues a UTF-8 sequence that another has begun.
[[nodiscard]] constexpr bool is_utf8_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}
/// Bytes of the first code point of a text that is not empty; a byte that begins no well-formed UTF-8
/// sequence counts as one.
[[nodiscard]] std::size_t code_point_size(std::string_view text);
/// How many of them the text is made of.
[[nodiscard]] int code_points(std::string_view text);

[[nodiscard]] std::string_view trim(std::string_view text);
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);
[[nodiscard]] std::string join(std::span<const std::string> parts, std::string_view separator);
[[nodiscard]] std::string lower(std::string_view text);

/// The candidate nearest to `word`, if near enough to be meant; empty otherwise.
[[nodiscard]] std::string_view did_you_mean(std::string_view word,
                                            std::span<const std::string_view> candidates);

/// Any bytes as printable ASCII/UTF-8 that is safe on a terminal and in XML: invalid UTF-8, C0/C1 control
/// bytes and bidirectional marks appear as \xNN. Newlines and tabs are escaped as well unless `keep_lines`.
[[nodiscard]] std::string printable(std::string_view text, bool keep_lines = false);

}  // namespace conform
