// SPDX-License-Identifier: Apache-2.0
#include "reports/text_tools.hpp"

#include "catch.hpp"

using namespace conform;
using namespace conform::reports;
using namespace std::chrono_literals;

TEST_CASE("Text is measured and cut by characters") {
  CHECK(columns("Süd") == 3);
  CHECK(pad_right("Süd", 5) == "Süd  ");
  CHECK(pad_left("12", 4) == "  12");
  CHECK(clip("abcdef", 6) == "abcdef");
  CHECK(clip("äbcdefg", 6) == "äbc...");
  CHECK(clip("abcdef", 2) == "ab");
  CHECK(clip_front("abcdefä", 6) == "...efä");
  CHECK(clip_front("abcdef", 2) == "ef");
  CHECK(clip_bytes("aääääää", 8) == "aää...");
  CHECK(clip_bytes("aää", 5) == "aää");
}

TEST_CASE("Text is wrapped at blanks and words that are too long are split") {
  CHECK(wrap("", 10) == std::vector<std::string>{""});
  CHECK(wrap("one two three", 10) == std::vector<std::string>{"one two", "three"});
  CHECK(wrap("abcdefghijklmnopqrst uv", 10) == std::vector<std::string>{"abcdefghij", "klmnopqrst", "uv"});
  CHECK(wrap("a abcdefghijkl b", 10) == std::vector<std::string>{"a", "abcdefghij", "kl b"});
}

TEST_CASE("Prose collapses blanks and line breaks") {
  CHECK(prose("  One\n  sentence.\t \n") == "One sentence.");
  CHECK(prose("a\x01") == "a\\x01");
}

TEST_CASE("Marks that CI systems obey are made harmless") {
  CHECK(log_safe("::error::x") == "\\x3A\\x3Aerror\\x3A\\x3Ax");
  CHECK(log_safe("##vso[x]") == "\\x23\\x23vso[x]");
  CHECK(log_safe("1003h:00 #1") == "1003h:00 #1");
}

TEST_CASE("Durations are rounded for reading") {
  CHECK(brief_duration(0s) == "0.0 ms");
  CHECK(brief_duration(430us) == "0.4 ms");
  CHECK(brief_duration(9949us) == "9.9 ms");
  CHECK(brief_duration(9950us) == "10 ms");
  CHECK(brief_duration(12ms) == "12 ms");
  CHECK(brief_duration(999499us) == "999 ms");
  CHECK(brief_duration(999500us) == "1.00 s");
  CHECK(brief_duration(1240ms) == "1.24 s");
  CHECK(brief_duration(59994ms) == "59.99 s");
  CHECK(brief_duration(59995ms) == "1 min 00 s");
  CHECK(brief_duration(185s) == "3 min 05 s");
  CHECK(brief_duration(2h + 5min) == "2 h 05 min");
  CHECK(brief_duration(-5ms) == "0.0 ms");
}

TEST_CASE("Milliseconds and seconds have three decimals") {
  CHECK(milliseconds(1240us) == "1.240");
  CHECK(milliseconds(-500us) == "-0.500");
  CHECK(milliseconds(-1ns) == "0.000");
  CHECK(milliseconds(1999999ns) == "2.000");
  CHECK(seconds(12ms) == "0.012");
  CHECK(seconds(1999600us) == "2.000");
  CHECK(seconds(-1s) == "0.000");
}

TEST_CASE("Time stamps are UTC") {
  CHECK(utc_timestamp(0) == "1970-01-01T00:00:00Z");
  CHECK(utc_timestamp(1'795'305'301'999'999'999) == "2026-11-21T23:55:01Z");
  CHECK(utc_timestamp(951'782'400'000'000'000) == "2000-02-29T00:00:00Z");
  CHECK(utc_timestamp(-1) == "1969-12-31T23:59:59Z");
}

TEST_CASE("Counted nouns have their plural") {
  CHECK(counted(1, "case") == "1 case");
  CHECK(counted(0, "case") == "0 cases");
}
