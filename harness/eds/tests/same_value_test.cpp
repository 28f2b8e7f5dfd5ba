// SPDX-License-Identifier: Apache-2.0
// Values that mean the same, and such that only look like it.
#include "eds/same_value.hpp"

#include "catch.hpp"
#include "eds/file_date.hpp"

namespace {

using namespace conform::eds;

constexpr std::uint16_t boolean = 1, integer8 = 2, unsigned8 = 5, unsigned32 = 7, real32 = 8, string = 9,
                        octets = 10, real64 = 0x11;

TEST_CASE("Numbers are the same in whatever form") {
  CHECK(same_value("0x10", "16", unsigned32));
  CHECK(same_value("007", "7", unsigned8));
  CHECK(same_value("10h", "0x10", unsigned8));
  CHECK(same_value("16", "0x10", std::nullopt));
  CHECK_FALSE(same_value("0x10", "10", unsigned32));
  CHECK_FALSE(same_value("", "0", unsigned32));
  CHECK_FALSE(same_value("300", "44", unsigned8));
}

TEST_CASE("A formula is the same in whatever order, and no plain number") {
  CHECK(same_value("$NODEID+0x180", "0x180+$NODEID", unsigned32));
  CHECK(same_value("$NodeID + 384", "$NODEID+0x180", unsigned32));
  CHECK_FALSE(same_value("$NODEID+0x180", "0x181", unsigned32));
}

TEST_CASE("An integer and its two's complement are the same") {
  CHECK(same_value("-1", "0xFF", integer8));
  CHECK(same_value("-0x80", "0x80", integer8));
  CHECK_FALSE(same_value("-1", "0xFE", integer8));
  CHECK_FALSE(same_value("-1", "0xFF", std::nullopt));
}

TEST_CASE("Booleans of EDS and XDD are the same, and nothing is only a flag that is not set") {
  CHECK(same_value("1", "true", boolean));
  CHECK(same_value("0x0", "false", boolean));
  CHECK_FALSE(same_value("", "0", boolean));
  CHECK_FALSE(same_value("1", "false", boolean));
  CHECK(same_flag("", "no"));
  CHECK(same_flag("yes", "1"));
  CHECK(same_flag("TRUE", "true"));
  CHECK_FALSE(same_flag("true", "0"));
}

TEST_CASE("REAL is compared by value, decimal and as bits") {
  CHECK(same_value("1", "1.000", real32));
  CHECK(same_value("12.345", "1.2345e1", real32));
  CHECK(same_value("0x3F800000", "1.0", real32));
  CHECK(same_value("0x3FF0000000000000", "1", real64));
  CHECK_FALSE(same_value("1.0", "1.5", real32));
  CHECK_FALSE(same_value("0x3F800000", "1.0", real64));
}

TEST_CASE("Strings are compared byte by byte, octets without blanks") {
  CHECK_FALSE(same_value("007", "7", string));
  CHECK_FALSE(same_value("abc", "ABC", string));
  CHECK(same_value("56 34 12", "563412", octets));
  CHECK(same_value("ab", "AB", octets));
  CHECK_FALSE(same_value("12", "0x12", octets));
}

TEST_CASE("Dates and times are read in both forms and written in either") {
  CHECK(file_date("12-31-2020") == FileDate{2020, 12, 31});
  CHECK(file_date("2020-12-31") == FileDate{2020, 12, 31});
  CHECK(file_date("2020-12-31Z") == FileDate{2020, 12, 31});
  CHECK(file_date("2020-12-31-05:00") == FileDate{2020, 12, 31});
  CHECK(ini_date({2020, 2, 1}) == "02-01-2020");
  CHECK(xml_date({2020, 2, 1}) == "2020-02-01");
  for (const auto* bad : {"", "31-12-2020", "02-30-2020", "12-Feb-2009", "12-31-20", "2020-13-01", "a-b-c"})
    CHECK_FALSE(file_date(bad).has_value());
  CHECK(file_time("11:59PM") == 23U * 60 + 59);
  CHECK(file_time("12:00AM") == 0U);
  CHECK(file_time("12:30pm") == 12U * 60 + 30);
  CHECK(file_time("23:59:01.0000+02:00") == 23U * 60 + 59);
  CHECK(ini_time(0) == "12:00AM");
  CHECK(ini_time(13 * 60 + 5) == "01:05PM");
  CHECK(xml_time(13 * 60 + 5) == "13:05:00");
  for (const auto* bad : {"", "13:00PM", "24:00:00", "10:60AM", "10", "0:00AM", "10:30 noon"})
    CHECK_FALSE(file_time(bad).has_value());
}

}  // namespace
