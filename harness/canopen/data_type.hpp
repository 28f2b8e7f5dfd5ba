// SPDX-License-Identifier: Apache-2.0
// The basic data types of CiA 301 (7.1.4, 7.4.7; indices 0001h-001Bh): sizes, literals to wire bytes and back
// to our notation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/bytes.hpp"
#include "base/error.hpp"

namespace conform::canopen {

/// The value is the index of the type in the object dictionary (table 44). The holes 0Ch-0Eh have wire
/// formats of their own (TIME_OF_DAY, TIME_DIFFERENCE) or are reserved (0Eh, 17h).
enum class DataType : std::uint16_t {
  boolean = 0x01,
  integer8 = 0x02,
  integer16 = 0x03,
  integer32 = 0x04,
  unsigned8 = 0x05,
  unsigned16 = 0x06,
  unsigned32 = 0x07,
  real32 = 0x08,
  visible_string = 0x09,
  octet_string = 0x0A,
  unicode_string = 0x0B,
  time_of_day = 0x0C,
  time_difference = 0x0D,
  domain = 0x0F,
  integer24 = 0x10,
  real64 = 0x11,
  integer40 = 0x12,
  integer48 = 0x13,
  integer56 = 0x14,
  integer64 = 0x15,
  unsigned24 = 0x16,
  unsigned40 = 0x18,
  unsigned48 = 0x19,
  unsigned56 = 0x1A,
  unsigned64 = 0x1B,
};

/// The type with this index (as an EDS writes it); nullopt for reserved and complex types.
[[nodiscard]] std::optional<DataType> data_type_at(std::uint16_t index);
/// "UNSIGNED16" as CiA 301 writes it; nothing else is accepted.
[[nodiscard]] std::optional<DataType> parse_data_type(std::string_view name);
[[nodiscard]] std::string_view to_string(DataType type);

/// Bytes on the wire; nullopt where the length varies (strings, DOMAIN).
[[nodiscard]] std::optional<std::size_t> size_bytes(DataType type);
[[nodiscard]] bool is_signed(DataType type);
/// INTEGERn, UNSIGNEDn (not BOOLEAN).
[[nodiscard]] bool is_integer(DataType type);
[[nodiscard]] bool is_real(DataType type);
/// VISIBLE_STRING, OCTET_STRING, UNICODE_STRING.
[[nodiscard]] bool is_string(DataType type);

/// A literal of a scenario or profile as wire bytes: numbers as in conform::parse_number (INTEGERn also
/// "-5"), BOOLEAN "0", "1", "false", "true", REAL as decimal number, VISIBLE_STRING and UNICODE_STRING as the
/// text itself (UTF-8), OCTET_STRING, DOMAIN and the time types as bytes "4F 6B".
[[nodiscard]] Result<Bytes> encode(DataType type, std::string_view literal);
/// A number as wire bytes. For INTEGERn `value` is either non-negative and in range, or a negative number as
/// 64-bit two's complement. BOOLEAN takes 0 and 1. Fails for types that are not numbers of up to 64 bits, and
/// for values out of range.
[[nodiscard]] Result<Bytes> encode_integer(DataType type, std::uint64_t value);

/// Wire bytes in our notation: "05h", "01F4h", "0000 0191h", "-5", "true", "1.5", "\"text\"", "4F 6B". Bytes
/// whose number does not fit the type are printed as bytes with a remark: "91 01 (2 bytes, UNSIGNED32 has
/// 4)".
[[nodiscard]] std::string print(DataType type, ByteView bytes);
/// Bytes of unknown type: "91 01 00 00 (4 bytes)"; "(no bytes)".
[[nodiscard]] std::string print_untyped(ByteView bytes);

}  // namespace conform::canopen
