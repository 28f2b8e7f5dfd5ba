// SPDX-License-Identifier: Apache-2.0
#include "eds/same_value.hpp"

#include <string>

#include "catch.hpp"
#include "eds/read.hpp"

namespace {

using namespace conform;
using namespace conform::eds;

bool same(const std::string& a, const std::string& b, std::optional<std::uint16_t> type,
          std::optional<std::uint8_t> node = {}) {
  const auto field = [](const std::string& text) { return Field{text, {1, 1}, {1, 1}, true}; };
  const bool out = may_be_same_value(field(a), field(b), type, node);
  CHECK(may_be_same_value(field(b), field(a), type, node) == out);
  return out;
}

constexpr std::uint16_t boolean = 0x01, i8 = 0x02, i16 = 0x03, u8 = 0x05, u32 = 0x07, real32 = 0x08,
                        text = 0x09, octets = 0x0A, real64 = 0x11;

TEST_CASE("Numbers are one value in whatever notation") {
  CHECK(same("0x01", "1", u8));
  CHECK(same("010", "8", u8));
  CHECK_FALSE(same("010", "10", u8));
  CHECK(same("-1", "0xFFFF", i16));
  CHECK(same("-1", "0xFF", i8));
  CHECK_FALSE(same("-1", "0xFF", i16));
  CHECK(same("16", "0x10", std::nullopt));
}

TEST_CASE("A formula is the number that the node-ID makes of it") {
  CHECK(same("$NODEID+0x580", "0x585", u32, std::uint8_t{5}));
  CHECK_FALSE(same("$NODEID+0x580", "0x586", u32, std::uint8_t{5}));
  CHECK(same("$NODEID+0x580", "0x580+$NODEID", u32));
  CHECK_FALSE(same("$NODEID+0x580", "$NODEID+0x600", u32));
  // Without a node-ID it could be that of any.
  CHECK(same("$NODEID+0x580", "0x5FF", u32));
  CHECK_FALSE(same("$NODEID+0x580", "0x580", u32));
  CHECK_FALSE(same("$NODEID+0x580", "0x600", u32));
}

TEST_CASE("REAL, BOOLEAN, OCTET_STRING and VISIBLE_STRING are compared by what they are") {
  CHECK(same("1.5", "1.50", real32));
  CHECK(same("0x3FC00000", "1.5", real32));
  CHECK(same("0x3FF8000000000000", "15e-1", real64));
  CHECK_FALSE(same("1.5", "1.25", real32));
  CHECK(same("true", "1", boolean));
  CHECK(same("0", "false", boolean));
  CHECK(same("01 a2", "01A2", octets));
  CHECK_FALSE(same("left", "Left", text));
  CHECK_FALSE(same("1", "0x1", text));
}

TEST_CASE("What is no value of the type is compared as text") {
  CHECK(same("five", "five", u8));
  CHECK_FALSE(same("five", "5", u8));
  CHECK_FALSE(same("much", "1.5", real32));
}

}  // namespace
