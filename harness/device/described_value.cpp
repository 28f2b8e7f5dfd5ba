// SPDX-License-Identifier: Apache-2.0
#include "device/described_value.hpp"

#include <bit>
#include <cmath>
#include <string>

#include "base/text.hpp"
#include "eds/ini_file.hpp"
#include "eds/number.hpp"

namespace conform::device {
namespace {

using canopen::DataType;

std::unexpected<Error> no_value(DataType type, std::string_view why) {
  return fail("is no value of " + std::string(canopen::to_string(type)) + ": " + std::string(why));
}

std::string_view words(eds::NumberFault fault) {
  switch (fault) {
    case eds::NumberFault::empty: return "it is empty";
    case eds::NumberFault::not_a_number: return "it is no number";
    case eds::NumberFault::bad_octal: return "a number with a leading 0 is octal";
    case eds::NumberFault::too_large: break;
  }
  return "it has more than 64 bits";
}

/// A decimal number must lie in the range of the type; hexadecimal and octal ones are its bits.
Result<DescribedValue> integer(DataType type, std::string_view text) {
  const auto number = eds::parse_number(text);
  if (!number) return no_value(type, words(number.error()));
  const std::size_t size = canopen::size_bytes(type).value_or(8);
  const unsigned bits = type == DataType::boolean ? 1 : static_cast<unsigned>(size) * 8;
  const std::uint64_t all = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  const bool is_signed = canopen::is_signed(type);
  const std::uint64_t half = is_signed ? all >> 1U : all;
  std::uint64_t value = number->magnitude;
  if (number->negative) {
    if (!is_signed || value > half + 1) return no_value(type, "it is too small");
    value = (~value + 1) & all;
  } else if (value > (number->base == eds::NumberBase::decimal ? half : all)) {
    return no_value(type, "it is too large");
  }
  DescribedValue out{Bytes(size), number->node_id};
  store_le(out.bytes, value);
  return out;
}

Result<DescribedValue> real(DataType type, std::string_view text) {
  const std::size_t size = type == DataType::real32 ? 4 : 8;
  DescribedValue out{Bytes(size), false};
  if (text.starts_with("0x") || text.starts_with("0X")) {
    const auto bits = eds::parse_number(text);
    if (!bits) return no_value(type, words(bits.error()));
    if (size == 4 && bits->magnitude > 0xFFFF'FFFF) return no_value(type, "it has more than 32 bits");
    store_le(out.bytes, bits->magnitude);
    return out;
  }
  const auto value = eds::parse_real(text);
  if (!value) return no_value(type, "it is no number");
  if (size == 8) {
    store_le(out.bytes, std::bit_cast<std::uint64_t>(*value));
    return out;
  }
  const auto narrow = static_cast<float>(*value);
  if (std::isinf(narrow)) return no_value(type, "it is too large");
  store_le(out.bytes, std::bit_cast<std::uint32_t>(narrow));
  return out;
}

}  // namespace

Result<DescribedValue> read_described_value(DataType type, std::string_view text) {
  if (type == DataType::boolean) {
    for (const auto& [word, value] : {std::pair{"true", 1}, {"false", 0}}) {
      if (eds::same_word(text, word)) return DescribedValue{{static_cast<std::uint8_t>(value)}, false};
    }
    return integer(type, text);
  }
  if (canopen::is_integer(type)) return integer(type, text);
  if (canopen::is_real(type)) return real(type, text);
  switch (type) {
    case DataType::visible_string: return DescribedValue{Bytes(text.begin(), text.end()), false};
    case DataType::octet_string:
      if (auto bytes = parse_bytes(text)) return DescribedValue{std::move(*bytes), false};
      return no_value(type, "it is not made of pairs of hexadecimal digits");
    default: return no_value(type, "CiA 306 gives it no notation");
  }
}

Access access_of(eds::Access access) {
  switch (access) {
    case eds::Access::ro: return Access::ro;
    case eds::Access::wo: return Access::wo;
    case eds::Access::rw: return Access::rw;
    case eds::Access::rwr: return Access::rwr;
    case eds::Access::rww: return Access::rww;
    case eds::Access::constant: break;
  }
  return Access::constant;
}

}  // namespace conform::device
