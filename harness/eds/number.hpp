// SPDX-License-Identifier: Apache-2.0
// Numbers as CiA 306 writes them: decimal, 0x hexadecimal, octal after a leading 0, and $NODEID formulas; and
// as files write them in spite of that. What the number means as bytes of a data type is not decided here.
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string_view>

namespace conform::eds {

enum class NumberBase : std::uint8_t { decimal, hexadecimal, octal };

/// Ways of writing a number that the standard does not know or that are easily misread. A number may show
/// several.
struct Oddities {
  bool octal = false;              ///< a leading 0 changes the value: 012 is ten
  bool leading_zero = false;       ///< a leading 0 that changes nothing: 007, 0000
  bool trailing_h = false;         ///< 10h
  bool negative_hex = false;       ///< -0x10
  bool plus_sign = false;          ///< +5
  bool c_suffix = false;           ///< 0x10UL
  bool inline_comment = false;     ///< 5 ; five
  bool node_id_not_first = false;  ///< 0x80+$NODEID, which by the standard is no formula
  bool node_id_case = false;       ///< $NodeID
  bool formula_blanks = false;     ///< $NODEID + 0x80
  friend constexpr bool operator==(const Oddities&, const Oddities&) = default;
};

/// A number, or a formula: then the value is the node-ID plus `magnitude`.
struct Number {
  std::uint64_t magnitude = 0;
  bool negative = false;
  bool node_id = false;
  NumberBase base = NumberBase::decimal;
  Oddities odd;
  friend constexpr bool operator==(const Number&, const Number&) = default;
};

enum class NumberFault : std::uint8_t {
  empty,
  not_a_number,
  bad_octal,  ///< a leading 0 and a digit 8 or 9
  too_large,  ///< does not fit into 64 bits
};

/// Reads `text` leniently; what had to be forgiven is in `odd`.
[[nodiscard]] std::expected<Number, NumberFault> parse_number(std::string_view text);

/// A decimal number such as 12.345, -1e-3 or 7; nullopt for anything else, hexadecimal included.
[[nodiscard]] std::optional<double> parse_real(std::string_view text);

/// The text before an inline comment (`rw # read and write`, `0;`), without blanks. CiA 306 knows no inline
/// comments.
[[nodiscard]] std::string_view without_comment(std::string_view text);

}  // namespace conform::eds
