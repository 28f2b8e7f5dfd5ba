// SPDX-License-Identifier: Apache-2.0
#include "canopen/data_type.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "base/text.hpp"

namespace conform::canopen {
namespace {

enum class Class : std::uint8_t {
  boolean,
  signed_integer,
  unsigned_integer,
  real,
  visible,
  octets,
  unicode,
  raw
};

struct Row {
  DataType type;
  std::string_view name;
  std::uint8_t size;  ///< 0: varies
  Class kind;
};

constexpr std::array<Row, 25> rows{{
    {DataType::boolean, "BOOLEAN", 1, Class::boolean},
    {DataType::integer8, "INTEGER8", 1, Class::signed_integer},
    {DataType::integer16, "INTEGER16", 2, Class::signed_integer},
    {DataType::integer32, "INTEGER32", 4, Class::signed_integer},
    {DataType::unsigned8, "UNSIGNED8", 1, Class::unsigned_integer},
    {DataType::unsigned16, "UNSIGNED16", 2, Class::unsigned_integer},
    {DataType::unsigned32, "UNSIGNED32", 4, Class::unsigned_integer},
    {DataType::real32, "REAL32", 4, Class::real},
    {DataType::visible_string, "VISIBLE_STRING", 0, Class::visible},
    {DataType::octet_string, "OCTET_STRING", 0, Class::octets},
    {DataType::unicode_string, "UNICODE_STRING", 0, Class::unicode},
    {DataType::time_of_day, "TIME_OF_DAY", 6, Class::raw},
    {DataType::time_difference, "TIME_DIFFERENCE", 6, Class::raw},
    {DataType::domain, "DOMAIN", 0, Class::raw},
    {DataType::integer24, "INTEGER24", 3, Class::signed_integer},
    {DataType::real64, "REAL64", 8, Class::real},
    {DataType::integer40, "INTEGER40", 5, Class::signed_integer},
    {DataType::integer48, "INTEGER48", 6, Class::signed_integer},
    {DataType::integer56, "INTEGER56", 7, Class::signed_integer},
    {DataType::integer64, "INTEGER64", 8, Class::signed_integer},
    {DataType::unsigned24, "UNSIGNED24", 3, Class::unsigned_integer},
    {DataType::unsigned40, "UNSIGNED40", 5, Class::unsigned_integer},
    {DataType::unsigned48, "UNSIGNED48", 6, Class::unsigned_integer},
    {DataType::unsigned56, "UNSIGNED56", 7, Class::unsigned_integer},
    {DataType::unsigned64, "UNSIGNED64", 8, Class::unsigned_integer},
}};
static_assert(std::ranges::is_sorted(rows, {}, &Row::type));

const Row& row_of(DataType type) { return *std::ranges::lower_bound(rows, type, {}, &Row::type); }

std::unexpected<Error> not_a(DataType type, std::string_view literal, std::string hint) {
  return fail(fmt::format("'{}' is not a value of {}", printable(literal), to_string(type)), {},
              std::move(hint));
}

/// The value of a sign and one of our number forms as 64-bit two's complement; nullopt when it is none, or
/// below -2^63.
std::optional<std::uint64_t> parse_signed(std::string_view literal) {
  const bool negative = literal.starts_with('-');
  const auto magnitude = parse_number(negative ? literal.substr(1) : literal);
  if (!magnitude || !negative) return magnitude;
  if (*magnitude > (std::uint64_t{1} << 63U)) return std::nullopt;
  return ~*magnitude + 1U;
}

Result<Bytes> encode_real(DataType type, std::string_view literal) {
  double value = 0;
  const auto [end, error] = std::from_chars(literal.data(), literal.data() + literal.size(), value);
  if (error != std::errc{} || end != literal.data() + literal.size() || !std::isfinite(value)) {
    return not_a(type, literal, "write a decimal number such as 1.5 or -2e3");
  }
  if (type == DataType::real64) return to_le(std::bit_cast<std::uint64_t>(value), 8);
  // Parsed again as float: a detour over double could round twice.
  float narrow = 0;
  const auto parsed = std::from_chars(literal.data(), literal.data() + literal.size(), narrow);
  if (parsed.ec != std::errc{} || !std::isfinite(narrow))
    return not_a(type, literal, "out of the range of REAL32");
  return to_le(std::bit_cast<std::uint32_t>(narrow), 4);
}

/// Length of the UTF-8 sequence that `lead` begins; 0 when it begins none.
std::size_t utf8_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  return lead >= 0xF0 && lead < 0xF5 ? 4 : 0;
}

/// UTF-8 to UTF-16 little endian (UNICODE_STRING is an array of UNSIGNED16, 7.1.4.6); nullopt for invalid
/// UTF-8.
std::optional<Bytes> utf16_of(std::string_view text) {
  Bytes out;
  const auto put = [&](std::uint32_t unit) {
    out.push_back(static_cast<std::uint8_t>(unit & 0xFFU));
    out.push_back(static_cast<std::uint8_t>(unit >> 8U & 0xFFU));
  };
  while (!text.empty()) {
    const auto lead = static_cast<unsigned char>(text.front());
    const std::size_t length = utf8_length(lead);
    if (length == 0 || text.size() < length) return std::nullopt;
    std::uint32_t code = length == 1 ? lead : lead & (0x7FU >> length);
    for (std::size_t i = 1; i < length; ++i) {
      const auto next = static_cast<unsigned char>(text[i]);
      if ((next & 0xC0U) != 0x80U) return std::nullopt;
      code = code << 6U | (next & 0x3FU);
    }
    constexpr std::array<std::uint32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
    if (code < smallest[length] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return std::nullopt;
    if (code < 0x10000) {
      put(code);
    } else {
      put(0xD800U + ((code - 0x10000U) >> 10U));
      put(0xDC00U + ((code - 0x10000U) & 0x3FFU));
    }
    text.remove_prefix(length);
  }
  return out;
}

void append_utf8(std::string& out, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { out += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0U | code >> 6U);
    put(0x80U | (code & 0x3FU));
  } else if (code < 0x10000) {
    put(0xE0U | code >> 12U);
    put(0x80U | (code >> 6U & 0x3FU));
    put(0x80U | (code & 0x3FU));
  } else {
    put(0xF0U | code >> 18U);
    put(0x80U | (code >> 12U & 0x3FU));
    put(0x80U | (code >> 6U & 0x3FU));
    put(0x80U | (code & 0x3FU));
  }
}

/// Lone surrogates become three bytes that are no UTF-8, so that printable() shows them as bytes.
std::string utf8_of(ByteView bytes) {
  std::string out;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    std::uint32_t code = static_cast<std::uint32_t>(load_le(bytes.subspan(i, 2)));
    if (code >= 0xD800 && code < 0xDC00 && i + 3 < bytes.size()) {
      const auto low = static_cast<std::uint32_t>(load_le(bytes.subspan(i + 2, 2)));
      if (low >= 0xDC00 && low < 0xE000) {
        code = 0x10000U + ((code - 0xD800U) << 10U) + (low - 0xDC00U);
        i += 2;
      }
    }
    append_utf8(out, code);
  }
  return out;
}

constexpr std::size_t max_printed = 64;

std::string count_of(std::size_t bytes) { return fmt::format("{} byte{}", bytes, bytes == 1 ? "" : "s"); }

/// Bytes without their count, clipped: what a console line can take.
std::string clipped_bytes(ByteView bytes) {
  if (bytes.size() <= max_printed) return hex_bytes(bytes);
  return hex_bytes(bytes.first(max_printed)) + " .. (" + count_of(bytes.size()) + ")";
}

std::string quoted(std::string_view text, std::size_t total) {
  if (text.size() <= max_printed * 4) return fmt::format("\"{}\"", printable(text));
  return fmt::format("\"{}\" .. ({})", printable(text.substr(0, max_printed * 4)), count_of(total));
}

/// Hexadecimal with all digits of the type, in groups of four where that divides evenly: what parse_number
/// reads back.
std::string print_unsigned(std::uint64_t value, std::size_t size) {
  const std::string digits = fmt::format("{:0{}X}", value, size * 2);
  std::string out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i != 0 && i % 4 == 0 && digits.size() % 4 == 0) out += ' ';
    out += digits[i];
  }
  return out + "h";
}

std::uint64_t sign_extended(std::uint64_t value, std::size_t size) {
  const auto shift = static_cast<unsigned>(64 - size * 8);
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(value << shift) >> shift);
}

}  // namespace

std::optional<DataType> data_type_at(std::uint16_t index) {
  const auto found = std::ranges::lower_bound(rows, static_cast<DataType>(index), {}, &Row::type);
  if (found == rows.end() || found->type != static_cast<DataType>(index)) return std::nullopt;
  return found->type;
}

std::optional<DataType> parse_data_type(std::string_view name) {
  const auto found = std::ranges::find(rows, name, &Row::name);
  if (found == rows.end()) return std::nullopt;
  return found->type;
}

std::string_view to_string(DataType type) { return row_of(type).name; }

std::optional<std::size_t> size_bytes(DataType type) {
  const std::size_t size = row_of(type).size;
  if (size == 0) return std::nullopt;
  return size;
}

bool is_signed(DataType type) { return row_of(type).kind == Class::signed_integer; }
bool is_integer(DataType type) { return is_signed(type) || row_of(type).kind == Class::unsigned_integer; }
bool is_real(DataType type) { return row_of(type).kind == Class::real; }
bool is_string(DataType type) {
  const Class kind = row_of(type).kind;
  return kind == Class::visible || kind == Class::octets || kind == Class::unicode;
}

Result<Bytes> encode(DataType type, std::string_view literal) {
  const Row& row = row_of(type);
  switch (row.kind) {
    case Class::boolean:
      if (literal == "true") return Bytes{1};
      if (literal == "false") return Bytes{0};
      [[fallthrough]];
    case Class::unsigned_integer: {
      const auto value = parse_number(literal);
      if (!value) return not_a(type, literal, "write a number such as 17, 11h or 0000 0011h");
      return encode_integer(type, *value);
    }
    case Class::signed_integer: {
      const auto value = parse_signed(literal);
      // A positive literal above 2^63-1 would read as a negative number; it is out of every range.
      const bool wrapped = value && !literal.starts_with('-') && *value >> 63U != 0;
      if (!value || wrapped) return not_a(type, literal, "write a number such as -5, 17 or 11h");
      return encode_integer(type, *value);
    }
    case Class::real: return encode_real(type, literal);
    case Class::visible: return Bytes(literal.begin(), literal.end());
    case Class::unicode: {
      auto units = utf16_of(literal);
      if (!units) return not_a(type, literal, "the text is not valid UTF-8");
      return *std::move(units);
    }
    case Class::octets:
    case Class::raw: break;
  }
  auto bytes = parse_bytes(literal);
  if (!bytes) return not_a(type, literal, "write bytes such as 4F 6B");
  if (row.size != 0 && bytes->size() != row.size) {
    return not_a(type, literal, fmt::format("{} has {} bytes", row.name, row.size));
  }
  return *std::move(bytes);
}

Result<Bytes> encode_integer(DataType type, std::uint64_t value) {
  const Row& row = row_of(type);
  const unsigned bits = row.size * 8U;
  switch (row.kind) {
    case Class::boolean:
      if (value > 1) return fail(fmt::format("{} is out of the range 0..1 of BOOLEAN", value));
      break;
    case Class::unsigned_integer:
      if (bits < 64 && value >> bits != 0) {
        return fail(fmt::format("{} is out of the range 0..{} of {}", value, (std::uint64_t{1} << bits) - 1,
                                row.name));
      }
      break;
    case Class::signed_integer: {
      const auto number = static_cast<std::int64_t>(value);
      const auto max = static_cast<std::int64_t>((std::uint64_t{1} << (bits - 1)) - 1);
      if (number > max || number < -max - 1) {
        return fail(fmt::format("{} is out of the range {}..{} of {}", number, -max - 1, max, row.name));
      }
      break;
    }
    default: return fail(fmt::format("{} does not hold a number", row.name));
  }
  return to_le(value, row.size);
}

std::string print(DataType type, ByteView bytes) {
  const Row& row = row_of(type);
  if (row.size != 0 && bytes.size() != row.size) {
    std::string remark = fmt::format("({}, {} has {})", count_of(bytes.size()), row.name, row.size);
    if (bytes.empty()) return remark;
    return hex_bytes(bytes.first(std::min(bytes.size(), max_printed))) +
           (bytes.size() > max_printed ? " .. " : " ") + remark;
  }
  switch (row.kind) {
    case Class::boolean:
      return bytes[0] == 0 ? "false" : bytes[0] == 1 ? "true" : print_unsigned(bytes[0], 1);
    case Class::signed_integer:
      return fmt::format("{}", static_cast<std::int64_t>(sign_extended(load_le(bytes), row.size)));
    case Class::unsigned_integer: return print_unsigned(load_le(bytes), row.size);
    case Class::real:
      if (row.size == 4)
        return fmt::format("{}", std::bit_cast<float>(static_cast<std::uint32_t>(load_le(bytes))));
      return fmt::format("{}", std::bit_cast<double>(load_le(bytes)));
    case Class::visible: return quoted(std::string(bytes.begin(), bytes.end()), bytes.size());
    case Class::unicode:
      if (bytes.size() % 2 != 0) return clipped_bytes(bytes) + " (odd number of bytes)";
      return quoted(utf8_of(bytes), bytes.size());
    case Class::octets:
    case Class::raw: break;
  }
  return bytes.empty() ? "(no bytes)" : clipped_bytes(bytes);
}

std::string print_untyped(ByteView bytes) {
  if (bytes.empty()) return "(no bytes)";
  if (bytes.size() > max_printed) return clipped_bytes(bytes);
  return hex_bytes(bytes) + " (" + count_of(bytes.size()) + ")";
}

}  // namespace conform::canopen
