// SPDX-License-Identifier: Apache-2.0
// Literals of scenarios to wire bytes and back, pinned byte by byte.
#include "canopen/data_type.hpp"

#include <limits>

#include "catch.hpp"

using namespace conform;
using namespace conform::canopen;

namespace {

Bytes ok(DataType type, std::string_view literal) {
  const auto bytes = encode(type, literal);
  INFO(to_string(type) << " '" << literal << "'");
  REQUIRE(bytes.has_value());
  return *bytes;
}

std::string error(DataType type, std::string_view literal) {
  const auto bytes = encode(type, literal);
  INFO(to_string(type) << " '" << literal << "'");
  REQUIRE_FALSE(bytes.has_value());
  return bytes.error().what;
}

}  // namespace

TEST_CASE("Every basic data type has its index, name and size") {
  CHECK(data_type_at(0x0006) == DataType::unsigned16);
  CHECK(data_type_at(0x000F) == DataType::domain);
  CHECK(data_type_at(0x001B) == DataType::unsigned64);
  CHECK_FALSE(data_type_at(0x0000).has_value());
  CHECK_FALSE(data_type_at(0x000E).has_value());
  CHECK_FALSE(data_type_at(0x0017).has_value());
  CHECK_FALSE(data_type_at(0x0020).has_value());
  int count = 0;
  for (std::uint16_t index = 0; index < 0x100; ++index) {
    const auto type = data_type_at(index);
    if (!type) continue;
    ++count;
    CHECK(static_cast<std::uint16_t>(*type) == index);
    CHECK(parse_data_type(to_string(*type)) == type);
  }
  CHECK(count == 25);
  CHECK(size_bytes(DataType::boolean) == 1U);
  CHECK(size_bytes(DataType::unsigned24) == 3U);
  CHECK(size_bytes(DataType::time_of_day) == 6U);
  CHECK(size_bytes(DataType::integer56) == 7U);
  CHECK(size_bytes(DataType::real64) == 8U);
  CHECK_FALSE(size_bytes(DataType::visible_string).has_value());
  CHECK_FALSE(size_bytes(DataType::domain).has_value());
  CHECK_FALSE(parse_data_type("unsigned16").has_value());
  CHECK_FALSE(parse_data_type("UNSIGNED12").has_value());
}

TEST_CASE("Types are sorted into integers, reals and strings") {
  CHECK(is_integer(DataType::unsigned8));
  CHECK(is_integer(DataType::integer64));
  CHECK_FALSE(is_integer(DataType::boolean));
  CHECK(is_signed(DataType::integer24));
  CHECK_FALSE(is_signed(DataType::unsigned24));
  CHECK(is_real(DataType::real32));
  CHECK(is_string(DataType::octet_string));
  CHECK_FALSE(is_string(DataType::domain));
}

TEST_CASE("Unsigned literals become little-endian bytes of their type") {
  CHECK(ok(DataType::unsigned8, "05h") == Bytes{0x05});
  CHECK(ok(DataType::unsigned16, "1000") == Bytes{0xE8, 0x03});
  CHECK(ok(DataType::unsigned32, "0000 0191h") == Bytes{0x91, 0x01, 0x00, 0x00});
  CHECK(ok(DataType::unsigned24, "123456h") == Bytes{0x56, 0x34, 0x12});
  CHECK(ok(DataType::unsigned64, "18446744073709551615") == Bytes(8, 0xFF));
  CHECK(error(DataType::unsigned8, "256") == "256 is out of the range 0..255 of UNSIGNED8");
  CHECK(error(DataType::unsigned8, "-1") == "'-1' is not a value of UNSIGNED8");
  CHECK(error(DataType::unsigned16, "010") == "'010' is not a value of UNSIGNED16");
  CHECK(error(DataType::unsigned16, "") == "'' is not a value of UNSIGNED16");
}

TEST_CASE("Signed literals become two's complement of their length") {
  CHECK(ok(DataType::integer8, "-1") == Bytes{0xFF});
  CHECK(ok(DataType::integer8, "-128") == Bytes{0x80});
  CHECK(ok(DataType::integer16, "-2") == Bytes{0xFE, 0xFF});
  CHECK(ok(DataType::integer24, "-3") == Bytes{0xFD, 0xFF, 0xFF});
  CHECK(ok(DataType::integer32, "7FFF FFFFh") == Bytes{0xFF, 0xFF, 0xFF, 0x7F});
  CHECK(ok(DataType::integer64, "-9223372036854775808") == Bytes{0, 0, 0, 0, 0, 0, 0, 0x80});
  CHECK(error(DataType::integer8, "128") == "128 is out of the range -128..127 of INTEGER8");
  CHECK(error(DataType::integer8, "-129") == "-129 is out of the range -128..127 of INTEGER8");
  CHECK(error(DataType::integer64, "9223372036854775808") ==
        "'9223372036854775808' is not a value of INTEGER64");
  CHECK(error(DataType::integer64, "-9223372036854775809") ==
        "'-9223372036854775809' is not a value of INTEGER64");
  CHECK(error(DataType::integer16, "--1") == "'--1' is not a value of INTEGER16");
}

TEST_CASE("Numbers are range-checked against their type") {
  CHECK(encode_integer(DataType::boolean, 1) == Bytes{1});
  CHECK_FALSE(encode_integer(DataType::boolean, 2).has_value());
  CHECK(encode_integer(DataType::integer8, static_cast<std::uint64_t>(std::int64_t{-5})) == Bytes{0xFB});
  CHECK_FALSE(encode_integer(DataType::integer8, 0xFB).has_value());
  CHECK(encode_integer(DataType::integer64, std::numeric_limits<std::uint64_t>::max()) == Bytes(8, 0xFF));
  CHECK(encode_integer(DataType::unsigned56, 0x00FF'FFFF'FFFF'FFFFU) == Bytes(7, 0xFF));
  CHECK_FALSE(encode_integer(DataType::unsigned56, 0x0100'0000'0000'0000U).has_value());
  CHECK_FALSE(encode_integer(DataType::visible_string, 1).has_value());
  CHECK_FALSE(encode_integer(DataType::real32, 1).has_value());
}

TEST_CASE("Booleans, reals, strings and raw bytes have literals of their own") {
  CHECK(ok(DataType::boolean, "true") == Bytes{1});
  CHECK(ok(DataType::boolean, "0") == Bytes{0});
  CHECK(ok(DataType::real32, "1.5") == Bytes{0x00, 0x00, 0xC0, 0x3F});
  CHECK(ok(DataType::real64, "-2") == Bytes{0, 0, 0, 0, 0, 0, 0, 0xC0});
  CHECK(error(DataType::real32, "1e39") == "'1e39' is not a value of REAL32");
  CHECK(error(DataType::real64, "nan") == "'nan' is not a value of REAL64");
  CHECK(error(DataType::real64, "1,5") == "'1,5' is not a value of REAL64");
  CHECK(ok(DataType::visible_string, "OK") == Bytes{0x4F, 0x4B});
  CHECK(ok(DataType::visible_string, "").empty());
  CHECK(ok(DataType::octet_string, "4F 6B") == Bytes{0x4F, 0x6B});
  CHECK(ok(DataType::unicode_string, "A\u20AC") == Bytes{0x41, 0x00, 0xAC, 0x20});
  CHECK(ok(DataType::unicode_string, "\U0001F600") == Bytes{0x3D, 0xD8, 0x00, 0xDE});
  CHECK(error(DataType::unicode_string, "\xFF") == "'\\xFF' is not a value of UNICODE_STRING");
  CHECK(ok(DataType::domain, "").empty());
  CHECK(ok(DataType::time_of_day, "00 00 00 00 01 00") == Bytes{0, 0, 0, 0, 1, 0});
  CHECK(error(DataType::time_of_day, "00 00") == "'00 00' is not a value of TIME_OF_DAY");
  CHECK(error(DataType::domain, "4") == "'4' is not a value of DOMAIN");
}

TEST_CASE("Values are printed in the notation of the field") {
  CHECK(print(DataType::unsigned8, Bytes{0x05}) == "05h");
  CHECK(print(DataType::unsigned16, Bytes{0xF4, 0x01}) == "01F4h");
  CHECK(print(DataType::unsigned24, Bytes{0x56, 0x34, 0x12}) == "123456h");
  CHECK(print(DataType::unsigned32, Bytes{0x91, 0x01, 0x00, 0x00}) == "0000 0191h");
  CHECK(print(DataType::unsigned64, Bytes{1, 0, 0, 0, 0, 0, 0, 0x80}) == "8000 0000 0000 0001h");
  CHECK(print(DataType::integer8, Bytes{0xFB}) == "-5");
  CHECK(print(DataType::integer24, Bytes{0xFF, 0xFF, 0x7F}) == "8388607");
  CHECK(print(DataType::integer64, Bytes{0, 0, 0, 0, 0, 0, 0, 0x80}) == "-9223372036854775808");
  CHECK(print(DataType::boolean, Bytes{1}) == "true");
  CHECK(print(DataType::boolean, Bytes{2}) == "02h");
  CHECK(print(DataType::real32, Bytes{0x00, 0x00, 0xC0, 0x3F}) == "1.5");
  CHECK(print(DataType::real32, Bytes{0xCD, 0xCC, 0xCC, 0x3D}) == "0.1");
  CHECK(print(DataType::visible_string, Bytes{0x4F, 0x4B, 0x00}) == "\"OK\\x00\"");
  CHECK(print(DataType::unicode_string, Bytes{0x41, 0x00, 0xAC, 0x20, 0x3D, 0xD8, 0x00, 0xDE}) ==
        "\"A\u20AC\U0001F600\"");
  CHECK(print(DataType::unicode_string, Bytes{0x3D, 0xD8}) == "\"\\xED\\xA0\\xBD\"");
  CHECK(print(DataType::octet_string, Bytes{0x4F, 0x6B}) == "4F 6B");
  CHECK(print(DataType::domain, {}) == "(no bytes)");
}

TEST_CASE("Bytes that do not fit their type are printed as bytes with the reason") {
  CHECK(print(DataType::unsigned32, Bytes{0x91, 0x01}) == "91 01 (2 bytes, UNSIGNED32 has 4)");
  CHECK(print(DataType::unsigned8, {}) == "(0 bytes, UNSIGNED8 has 1)");
  CHECK(print_untyped(Bytes{0x91, 0x01, 0x00, 0x00}) == "91 01 00 00 (4 bytes)");
  CHECK(print_untyped(Bytes{0x91}) == "91 (1 byte)");
  CHECK(print_untyped({}) == "(no bytes)");
}

TEST_CASE("Long values are clipped, their length is kept") {
  const std::string domain = print(DataType::domain, Bytes(100000, 0xAA));
  CHECK(domain.size() < 300);
  CHECK(domain.ends_with("AA .. (100000 bytes)"));
  const std::string text = print(DataType::visible_string, Bytes(100000, 'x'));
  CHECK(text.size() < 300);
  CHECK(text.ends_with("xx\" .. (100000 bytes)"));
  CHECK(print_untyped(Bytes(65, 1)).ends_with("01 .. (65 bytes)"));
}

TEST_CASE("What is printed for an unsigned number reads back as the same bytes") {
  for (const auto type :
       {DataType::unsigned8, DataType::unsigned16, DataType::unsigned24, DataType::unsigned32,
        DataType::unsigned40, DataType::unsigned48, DataType::unsigned56, DataType::unsigned64,
        DataType::integer16, DataType::integer40}) {
    const Bytes bytes = to_le(0xFEDC'BA98'7654'3210U, *size_bytes(type));
    CHECK(encode(type, print(type, bytes)) == bytes);
  }
}
