// SPDX-License-Identifier: Apache-2.0
// The notation is what engineers read and write: every form is pinned literally.
#include "base/text.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "catch.hpp"

using namespace conform;

TEST_CASE("Numbers are written in the notation of the field") {
  CHECK(hex(0x1F, 2) == "1Fh");
  CHECK(hex(0, 2) == "00h");
  CHECK(hex(0x12345, 4) == "12345h");
  CHECK(hex(0xA, 0) == "Ah");
  CHECK(hex(std::numeric_limits<std::uint64_t>::max(), 1) == "FFFFFFFFFFFFFFFFh");
  CHECK(to_string(Index{0x1003}) == "1003h");
  CHECK(to_string(SubIndex{0}) == "00h");
  CHECK(to_string(Multiplexer{Index{0x1A00}, SubIndex{0xFE}}) == "1A00h:FE");
  CHECK(to_string(AbortCode{0x06090030}) == "0609 0030h");
  CHECK(to_string(CanId{0x0}) == "000h");
  CHECK(to_string(CanId{0x6A0}) == "6A0h");
  CHECK(to_string(CanId{0x7FF}) == "7FFh");
  CHECK(to_string(CanId{0x800}) == "0000 0800h");
  CHECK(to_string(CanId{0x1FFFFFFF}) == "1FFF FFFFh");
}

TEST_CASE("Bytes are written and read in transmission order") {
  CHECK(hex_bytes({}).empty());
  CHECK(hex_bytes(Bytes{0x2F, 0x03, 0x10, 0x00}) == "2F 03 10 00");
  CHECK(parse_bytes("2F 03 10 00") == Bytes{0x2F, 0x03, 0x10, 0x00});
  CHECK(parse_bytes("2f031000") == Bytes{0x2F, 0x03, 0x10, 0x00});
  CHECK(parse_bytes(" 2F03  10 00 ") == Bytes{0x2F, 0x03, 0x10, 0x00});
  CHECK(parse_bytes("") == Bytes{});
  for (const char* bad : {"2", "2F0", "2 F0", "2G", "0x2F", "2F,03", "2F 0"}) {
    INFO(bad);
    CHECK_FALSE(parse_bytes(bad).has_value());
  }
}

TEST_CASE("Durations are written in the largest unit that needs at most three decimals") {
  using namespace std::chrono_literals;
  CHECK(to_string(Duration{250us}) == "250 us");
  CHECK(to_string(Duration{100ms}) == "100 ms");
  CHECK(to_string(Duration{1500ms}) == "1.5 s");
  CHECK(to_string(Duration{0}) == "0 s");
  CHECK(to_string(Duration{1s}) == "1 s");
  CHECK(to_string(Duration{1234567us}) == "1234.567 ms");
  CHECK(to_string(Duration{1001ms}) == "1.001 s");
  CHECK(to_string(Duration{1ns}) == "1 ns");
  CHECK(to_string(Duration{1500ns}) == "1.5 us");
  CHECK(to_string(Duration{1000000001ns}) == "1000000.001 us");
  CHECK(to_string(Duration{-20ms}) == "-20 ms");
  CHECK(to_string(Duration::min()) == "-9223372036854775.808 us");
}

TEST_CASE("Numbers are read in four forms") {
  CHECK(parse_number("0") == 0U);
  CHECK(parse_number("17") == 17U);
  CHECK(parse_number("1Fh") == 0x1FU);
  CHECK(parse_number("1fh") == 0x1FU);
  CHECK(parse_number("0h") == 0U);
  CHECK(parse_number("00h") == 0U);
  CHECK(parse_number("0x1F") == 0x1FU);
  CHECK(parse_number("0609 0030h") == 0x06090030U);
  CHECK(parse_number("80000000h") == 0x80000000U);
  CHECK(parse_number("18446744073709551615") == std::numeric_limits<std::uint64_t>::max());
  CHECK(parse_number("FFFFFFFFFFFFFFFFh") == std::numeric_limits<std::uint64_t>::max());
}

TEST_CASE("Numbers that YAML readers disagree on are refused") {
  for (const char* bad : {"",
                          "010",
                          "00",
                          "+1",
                          "-1",
                          "1_000",
                          "1.0",
                          "1e3",
                          "0b1",
                          "0o7",
                          "1F",
                          "h",
                          "0x",
                          "0X1F",
                          "1FH",
                          "0x1Fh",
                          " 1",
                          "1 ",
                          "1 000",
                          "0609 030h",
                          "0609  0030h",
                          "0609 0030",
                          " 0609 0030h",
                          "18446744073709551616",
                          "10000000000000000h",
                          "0x00000000000000000",
                          "1\xC2\xB2"}) {
    INFO(bad);
    CHECK_FALSE(parse_number(bad).has_value());
  }
}

TEST_CASE("Multiplexers are read with and without sub-index") {
  const Multiplexer error_count{Index{0x1003}, SubIndex{0}};
  CHECK(parse_multiplexer("1003h:00") == error_count);
  CHECK(parse_multiplexer("1003h") == error_count);
  CHECK(parse_multiplexer("0x1003:0x00") == error_count);
  CHECK(parse_multiplexer("0x1003:00") == error_count);
  CHECK(parse_multiplexer("1003h:0") == error_count);
  CHECK(parse_multiplexer("1018h:1Fh") == Multiplexer{Index{0x1018}, SubIndex{0x1F}});
  CHECK(parse_multiplexer("1018h:10") == Multiplexer{Index{0x1018}, SubIndex{0x10}});
  for (const char* bad : {"", ":", "1003", "1003:00", "1003h:", "1003h:100", "10030h:00", "1003h:00:00",
                          "1003h :00", "1003h: 00", "1003h:-1", "G003h:00", "1003h:0x"}) {
    INFO(bad);
    CHECK_FALSE(parse_multiplexer(bad).has_value());
  }
}

TEST_CASE("Durations are read with a unit") {
  using namespace std::chrono_literals;
  CHECK(parse_duration("100 ms") == Duration{100ms});
  CHECK(parse_duration("100ms") == Duration{100ms});
  CHECK(parse_duration("1 s") == Duration{1s});
  CHECK(parse_duration("1.5 s") == Duration{1500ms});
  CHECK(parse_duration("250 us") == Duration{250us});
  CHECK(parse_duration("10 ns") == Duration{10ns});
  CHECK(parse_duration("2 min") == Duration{2min});
  CHECK(parse_duration("0.000000001 s") == Duration{1ns});
  CHECK(parse_duration("0 ms") == Duration{0});
  CHECK(parse_duration("1440 min") == Duration{24h});
  CHECK(parse_duration("86400.000000000 s") == Duration{24h});
  for (const char* bad :
       {"", "100", "ms", " 100 ms", "-1 s", "+1 s", "1,5 s", "1. s", ".5 s", "1.2.3 s", "1 h", "1 sec", "1 S",
        "1e3 ms", "0.0000000001 s", "0.5 ns", "1440.1 min", "86401 s", "99999999999999999999 ms"}) {
    INFO(bad);
    CHECK_FALSE(parse_duration(bad).has_value());
  }
}

TEST_CASE("Every duration we write is read back as the same duration") {
  for (const std::int64_t count :
       {0L, 1L, 999L, 1000L, 1234L, 250000L, 5000000L, 1500000000L, 86400000000000L, 86399999999999L}) {
    const Duration duration{count};
    CHECK(parse_duration(to_string(duration)) == duration);
  }
}

TEST_CASE("Text is trimmed, split, joined and lowered without a locale") {
  CHECK(trim(" \t a b \r\n") == "a b");
  CHECK(trim(" \n").empty());
  CHECK(split("a,b,,c", ',') == std::vector<std::string_view>{"a", "b", "", "c"});
  CHECK(split("", ',') == std::vector<std::string_view>{""});
  const std::array<std::string, 3> parts{"a", "", "c"};
  CHECK(join(parts, ", ") == "a, , c");
  CHECK(join({}, ", ").empty());
  CHECK(lower("AbÄ") == "abÄ");
}

TEST_CASE("A typing slip finds the word that was meant") {
  constexpr std::array<std::string_view, 5> verbs{"upload", "download", "wait", "nmt", "expect-emcy"};
  CHECK(did_you_mean("upolad", verbs) == "upload");  // swapped neighbours count one
  CHECK(did_you_mean("downlod", verbs) == "download");
  CHECK(did_you_mean("UPLOAD", verbs) == "upload");
  CHECK(did_you_mean("nmtt", verbs) == "nmt");
  CHECK(did_you_mean("expect_emcy", verbs) == "expect-emcy");
  CHECK(did_you_mean("heartbeat", verbs).empty());
  CHECK(did_you_mean("", verbs).empty());
  CHECK(did_you_mean("x", verbs).empty());
  CHECK(did_you_mean(std::string(100000, 'u'), verbs).empty());
  CHECK(did_you_mean("upload", {}).empty());
}

TEST_CASE("Of two candidates equally near the first is named") {
  constexpr std::array<std::string_view, 2> words{"tpdo1", "tpdo2"};
  CHECK(did_you_mean("tpdo3", words) == "tpdo1");
}

TEST_CASE("One letter is not mistaken for another") {
  constexpr std::array<std::string_view, 1> words{"a"};
  CHECK(did_you_mean("b", words).empty());
  CHECK(did_you_mean("A", words) == "a");
}

TEST_CASE("Printable text stays as it is") {
  CHECK(printable("Antrieb Süd µ-Controller 5\u20AC \U0001F600 <&>\"'") ==
        "Antrieb Süd µ-Controller 5\u20AC \U0001F600 <&>\"'");
  CHECK(printable("").empty());
}

TEST_CASE("Control characters and invalid bytes appear as their bytes") {
  CHECK(printable(std::string_view("a\0b", 3)) == "a\\x00b");
  CHECK(printable("\x1B[31mred\x1B[0m") == "\\x1B[31mred\\x1B[0m");
  CHECK(printable("\x7F") == "\\x7F");
  CHECK(printable("\xC2\x9B") == "\\xC2\\x9B");  // C1 control sequence introducer
  CHECK(printable("\xFF\xFE") == "\\xFF\\xFE");
  CHECK(printable("\xC0\x80") == "\\xC0\\x80");           // overlong NUL
  CHECK(printable("\xE0\x80\xAF") == "\\xE0\\x80\\xAF");  // overlong slash
  CHECK(printable("\xED\xA0\x80") == "\\xED\\xA0\\x80");  // surrogate D800
  CHECK(printable("\xEF\xBF\xBE\xEF\xBF\xBF") == "\\xEF\\xBF\\xBE\\xEF\\xBF\\xBF");
  CHECK(printable("\xF4\x90\x80\x80") == "\\xF4\\x90\\x80\\x80");  // above 10FFFF
  CHECK(printable("\xE2\x82") == "\\xE2\\x82");                    // cut off
  CHECK(printable("\xE2\x82"
                  "a") == "\\xE2\\x82"
                          "a");
}

TEST_CASE("Marks that reorder text are made visible") {
  for (const char* mark : {"\u200E", "\u200F", "\u202A", "\u202B", "\u202C", "\u202D", "\u202E", "\u2066",
                           "\u2067", "\u2068", "\u2069", "\u061C"}) {
    CHECK(printable(mark).starts_with("\\x"));
  }
  CHECK(printable("\u202E") == "\\xE2\\x80\\xAE");
  CHECK(printable("\u2065") == "\u2065");
}

TEST_CASE("Newlines and tabs survive only where lines are kept") {
  CHECK(printable("a\nb\tc\r") == "a\\x0Ab\\x09c\\x0D");
  CHECK(printable("a\nb\tc\r", true) == "a\nb\tc\\x0D");
}

TEST_CASE("Printable output is printable: a second pass changes nothing") {
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  for (int i = 255; i >= 0; --i) all += static_cast<char>(i);
  const std::string once = printable(all);
  CHECK(printable(once) == once);
}

TEST_CASE("A range of numbers has two ends, one, or no upper one") {
  const auto range = [](std::string_view text) {
    const auto parsed = parse_number_range(text);
    return parsed ? std::pair(parsed->low, parsed->high) : std::pair(std::uint64_t{1}, std::uint64_t{0});
  };
  CHECK(range("2000h..5FFFh") == std::pair(std::uint64_t{0x2000}, std::uint64_t{0x5FFF}));
  CHECK(range("4") == std::pair(std::uint64_t{4}, std::uint64_t{4}));
  CHECK(range("15..") == std::pair(std::uint64_t{15}, ~std::uint64_t{0}));
  for (const std::string_view wrong : {"", "..", "..5", "2000h..x", "4...5", "a..b", "5..4"}) {
    CAPTURE(wrong);
    CHECK_FALSE(parse_number_range(wrong).has_value());
  }
  CHECK(parse_number_range("1..3")->holds(3));
  CHECK_FALSE(parse_number_range("1..3")->holds(4));
}
