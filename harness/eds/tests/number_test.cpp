// SPDX-License-Identifier: Apache-2.0
// Numbers as device descriptions write them.
#include "eds/number.hpp"
#include "catch.hpp"

namespace {

using namespace conform::eds;

Number plain(std::uint64_t magnitude, NumberBase base = NumberBase::decimal) {
  Number out;
  out.magnitude = magnitude;
  out.base = base;
  return out;
}

Number formula(std::uint64_t offset, NumberBase base = NumberBase::hexadecimal) {
  auto out = plain(offset, base);
  out.node_id = true;
  return out;
}

TEST_CASE("Decimal, hexadecimal and octal numbers are read as the standard writes them") {
  CHECK(parse_number("17") == plain(17));
  CHECK(parse_number("0") == plain(0));
  CHECK(parse_number("0x1F") == plain(31, NumberBase::hexadecimal));
  CHECK(parse_number("0X1f") == plain(31, NumberBase::hexadecimal));
  CHECK(parse_number("0x00000007") == plain(7, NumberBase::hexadecimal));
  CHECK(parse_number("0xFFFFFFFFFFFFFFFF") == plain(0xFFFFFFFFFFFFFFFFU, NumberBase::hexadecimal));
  CHECK(parse_number("18446744073709551615") == plain(0xFFFFFFFFFFFFFFFFU));
  auto minus = plain(5);
  minus.negative = true;
  CHECK(parse_number("-5") == minus);
}

TEST_CASE("A leading zero means octal, and is remarked whether it changes the value or not") {
  auto ten = plain(10, NumberBase::octal);
  ten.odd.octal = true;
  CHECK(parse_number("012") == ten);
  auto seven = plain(7, NumberBase::octal);
  seven.odd.leading_zero = true;
  CHECK(parse_number("007") == seven);
  auto nothing = plain(0, NumberBase::octal);
  nothing.odd.leading_zero = true;
  CHECK(parse_number("00000000000000000000") == nothing);
  CHECK(parse_number("018").error() == NumberFault::bad_octal);
}

TEST_CASE("A formula is the node-ID and a number") {
  CHECK(parse_number("$NODEID+0x180") == formula(0x180));
  CHECK(parse_number("$NODEID+384") == formula(384, NumberBase::decimal));
  CHECK(parse_number("$NODEID") == formula(0, NumberBase::decimal));
}

TEST_CASE("A formula in another order, case or spacing is understood and remarked") {
  auto swapped = formula(0x80);
  swapped.odd.node_id_not_first = true;
  CHECK(parse_number("0x80+$NODEID") == swapped);
  auto spaced = formula(0x200);
  spaced.odd.formula_blanks = true;
  spaced.odd.node_id_case = true;
  CHECK(parse_number("$NodeID + 0x200") == spaced);
}

TEST_CASE("What other languages write is understood and remarked") {
  auto h = plain(0x10, NumberBase::hexadecimal);
  h.odd.trailing_h = true;
  CHECK(parse_number("10h") == h);
  auto suffix = plain(0x1234567890ABCDEF, NumberBase::hexadecimal);
  suffix.odd.c_suffix = true;
  CHECK(parse_number("0x1234567890ABCDEFLL") == suffix);
  auto negative = plain(0x10, NumberBase::hexadecimal);
  negative.negative = true;
  negative.odd.negative_hex = true;
  CHECK(parse_number("-0x10") == negative);
  auto plus = plain(5);
  plus.odd.plus_sign = true;
  CHECK(parse_number("+5") == plus);
  auto comment = plain(7, NumberBase::hexadecimal);
  comment.odd.inline_comment = true;
  CHECK(parse_number("0x07 # VAR") == comment);
  comment = plain(0);
  comment.odd.inline_comment = true;
  CHECK(parse_number("0;") == comment);
}

TEST_CASE("What is no number says why") {
  CHECK(parse_number("").error() == NumberFault::empty);
  CHECK(parse_number("  ").error() == NumberFault::empty);
  CHECK(parse_number("0x10000000000000000").error() == NumberFault::too_large);
  CHECK(parse_number("18446744073709551616").error() == NumberFault::too_large);
  for (const char* text : {"abc", "0x", "0xG", "12.5", "--5", "+-5", "$NODE", "$NODEID+", "$NODEID-1",
                           "$NODEID+$NODEID", "h", "-", "5ULLL", "#5"}) {
    CAPTURE(text);
    REQUIRE_FALSE(parse_number(text));
    CHECK(parse_number(text).error() == NumberFault::not_a_number);
  }
}

TEST_CASE("Real numbers are decimal texts") {
  CHECK(parse_real("12.345") == 12.345);
  CHECK(parse_real("-1e-3") == -0.001);
  CHECK(parse_real("7") == 7.0);
  CHECK(parse_real("+0.5") == 0.5);
  for (const char* text : {"", "0x3F800000", "inf", "nan", "1,5", "1.5f"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_real(text));
  }
}

}  // namespace
