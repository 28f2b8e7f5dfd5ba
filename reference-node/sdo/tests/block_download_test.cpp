// SPDX-License-Identifier: Apache-2.0
// Block download as bytes on the wire (CiA 301, 7.2.4.3.8 to 7.2.4.3.11, 7.2.4.3.17).
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {

constexpr auto unchanged_1017 = "4B 17 10 00 00 00 00 00";

std::string value_of_1017(Bench& bench) { return bench.sdo("40 17 10 00 00 00 00 00"); }

/// The string 2006h:00 by segments.
std::string name(Bench& bench) {
  const std::string size = bench.sdo("40 06 20 00 00 00 00 00");
  REQUIRE(size.starts_with("41 06 20 00"));
  std::string all;
  for (int segment = 0;; ++segment) {
    const auto frame = conform::parse_bytes(
        bench.sdo(segment % 2 == 0 ? "60 00 00 00 00 00 00 00" : "70 00 00 00 00 00 00 00"));
    REQUIRE(frame.has_value());
    const int unused = ((*frame)[0] >> 1) & 7;
    all.append(frame->begin() + 1, frame->end() - unused);
    if (((*frame)[0] & 1) != 0) return all;
  }
}

}  // namespace

TEST_CASE("A block download runs through initiate, sub-block, acknowledge and end") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("C2 17 10 00 02 00 00 00") == "A4 17 10 00 7F 00 00 00");
  CHECK(bench.sdo("81 E8 03 00 00 00 00 00") == "A2 01 7F 00 00 00 00 00");
  // Without agreement on the CRC its field is not looked at, nor are the reserved bytes.
  CHECK(bench.sdo("D5 34 12 FF FF FF FF FF") == "A1 00 00 00 00 00 00 00");
  CHECK(value_of_1017(bench) == "4B 17 10 00 E8 03 00 00");
  CHECK(bench.sdo("D5 00 00 00 00 00 00 00") == "80 00 00 00 01 00 04 05");
  // Without size, reserved bits set.
  CHECK(bench.sdo("D8 17 10 00 00 00 00 00") == "A4 17 10 00 7F 00 00 00");
  CHECK(bench.sdo("81 D0 07 00 00 00 00 00") == "A2 01 7F 00 00 00 00 00");
  CHECK(bench.sdo("D5 00 00 00 00 00 00 00") == "A1 00 00 00 00 00 00 00");
  CHECK(value_of_1017(bench) == "4B 17 10 00 D0 07 00 00");
}

TEST_CASE("A CRC that was agreed on is checked over the data without padding") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("C6 17 10 00 02 00 00 00");
  bench.sdo("81 E8 03 FF FF FF FF FF");
  CHECK(bench.sdo("D5 79 A9 00 00 00 00 00") == "80 17 10 00 04 00 04 05");
  CHECK(value_of_1017(bench) == unchanged_1017);
  bench.sdo("C6 17 10 00 02 00 00 00");
  bench.sdo("81 E8 03 FF FF FF FF FF");
  CHECK(bench.sdo("D5 78 A9 00 00 00 00 00") == "A1 00 00 00 00 00 00 00");
}

TEST_CASE("Sub-blocks follow each other and every number starts with 1") {
  SdoChoices choices;
  choices.block_size = 2;
  choices.next_block_size = 1;
  Bench bench = Bench::choosing(choices);
  bench.wait(100ms);
  CHECK(bench.sdo("C6 06 20 00 18 00 00 00") == "A4 06 20 00 02 00 00 00");  // A to X
  CHECK(bench.sdo("01 41 42 43 44 45 46 47") == "");
  CHECK(bench.sdo("02 48 49 4A 4B 4C 4D 4E") == "A2 02 01 00 00 00 00 00");
  CHECK(bench.sdo("01 4F 50 51 52 53 54 55") == "A2 01 01 00 00 00 00 00");
  CHECK(bench.sdo("81 56 57 58 00 00 00 00") == "A2 01 01 00 00 00 00 00");
  CHECK(bench.sdo("D1 07 6B 00 00 00 00 00") == "A1 00 00 00 00 00 00 00");
  CHECK(name(bench) == "ABCDEFGHIJKLMNOPQRSTUVWX");
}

TEST_CASE("A lost segment is not acknowledged and can be sent again") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("C6 06 20 00 18 00 00 00");
  CHECK(bench.sdo("01 41 42 43 44 45 46 47") == "");
  CHECK(bench.sdo("03 4F 50 51 52 53 54 55") == "");
  CHECK(bench.sdo("84 56 57 58 00 00 00 00") == "A2 01 7F 00 00 00 00 00");
  CHECK(bench.sdo("01 48 49 4A 4B 4C 4D 4E") == "");
  CHECK(bench.sdo("02 4F 50 51 52 53 54 55") == "");
  CHECK(bench.sdo("83 56 57 58 00 00 00 00") == "A2 03 7F 00 00 00 00 00");
  CHECK(bench.sdo("D1 07 6B 00 00 00 00 00") == "A1 00 00 00 00 00 00 00");
  CHECK(name(bench) == "ABCDEFGHIJKLMNOPQRSTUVWX");
  // The first one lost.
  bench.sdo("C2 06 20 00 09 00 00 00");
  CHECK(bench.sdo("82 68 69 00 00 00 00 00") == "A2 00 7F 00 00 00 00 00");
  bench.sdo("01 61 62 63 64 65 66 67");
  CHECK(bench.sdo("82 68 69 00 00 00 00 00") == "A2 02 7F 00 00 00 00 00");
  CHECK(bench.sdo("D5 00 00 00 00 00 00 00") == "A1 00 00 00 00 00 00 00");
  CHECK(name(bench) == "abcdefghi");
}

TEST_CASE("A gap may be acknowledged at once, and the rest of the sub-block is then passed over") {
  SdoChoices choices;
  choices.ack_gap_at_once = true;
  Bench bench = Bench::choosing(choices);
  bench.wait(100ms);
  bench.sdo("C6 06 20 00 18 00 00 00");
  CHECK(bench.sdo("01 41 42 43 44 45 46 47") == "");
  CHECK(bench.sdo("03 4F 50 51 52 53 54 55") == "A2 01 7F 00 00 00 00 00");
  CHECK(bench.sdo("84 56 57 58 00 00 00 00") == "");
  CHECK(bench.sdo("01 48 49 4A 4B 4C 4D 4E") == "");
  CHECK(bench.sdo("02 4F 50 51 52 53 54 55") == "");
  CHECK(bench.sdo("83 56 57 58 00 00 00 00") == "A2 03 7F 00 00 00 00 00");
  CHECK(bench.sdo("D1 07 6B 00 00 00 00 00") == "A1 00 00 00 00 00 00 00");
}

TEST_CASE("A sub-block whose end is lost is acknowledged after a while") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("C2 06 20 00 10 00 00 00");
  CHECK(bench.sdo("01 41 42 43 44 45 46 47") == "");
  CHECK(bench.wait(249ms).empty());
  CHECK(bench.wait(2ms) == Frames{"585: A2 01 7F 00 00 00 00 00"});
  CHECK(bench.sdo("01 48 49 4A 4B 4C 4D 4E") == "");
  CHECK(bench.sdo("82 4F 50 00 00 00 00 00") == "A2 02 7F 00 00 00 00 00");
  CHECK(bench.sdo("D5 00 00 00 00 00 00 00") == "A1 00 00 00 00 00 00 00");
}

TEST_CASE("A repeated segment is taken once, and pauses between segments are no matter") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("C2 06 20 00 10 00 00 00");
  CHECK(bench.sdo("01 41 42 43 44 45 46 47") == "");
  CHECK(bench.sdo("01 41 42 43 44 45 46 47") == "");
  CHECK(bench.wait(20ms).empty());
  CHECK(bench.sdo("02 48 49 4A 4B 4C 4D 4E") == "");
  CHECK(bench.sdo("83 4F 50 00 00 00 00 00") == "A2 03 7F 00 00 00 00 00");
  bench.sdo("D5 00 00 00 00 00 00 00");
  CHECK(name(bench) == "ABCDEFGHIJKLMNOP");
}

TEST_CASE("Sequence numbers outside of the block are refused") {
  SdoChoices choices;
  choices.block_size = 4;
  Bench bench = Bench::choosing(choices);
  bench.wait(100ms);
  bench.sdo("C2 17 10 00 02 00 00 00");
  CHECK(bench.sdo("00 E8 03 00 00 00 00 00") == "80 17 10 00 03 00 04 05");
  bench.sdo("C2 17 10 00 02 00 00 00");
  CHECK(bench.sdo("05 E8 03 00 00 00 00 00") == "80 17 10 00 03 00 04 05");
  CHECK(value_of_1017(bench) == unchanged_1017);
}

TEST_CASE("The length of a block download must fit the object, the announcement and what came") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("C2 17 10 00 03 00 00 00") == "80 17 10 00 12 00 07 06");
  CHECK(bench.sdo("C2 17 10 00 01 00 00 00") == "80 17 10 00 13 00 07 06");
  bench.sdo("C2 17 10 00 02 00 00 00");
  bench.sdo("81 E8 00 00 00 00 00 00");
  CHECK(bench.sdo("D9 00 00 00 00 00 00 00") == "80 17 10 00 13 00 07 06");
  bench.sdo("C2 17 10 00 02 00 00 00");
  bench.sdo("81 E8 00 00 00 00 00 00");
  CHECK(bench.sdo("D1 00 00 00 00 00 00 00") == "80 17 10 00 12 00 07 06");
  bench.sdo("C2 17 10 00 02 00 00 00");
  CHECK(bench.sdo("01 E8 03 00 00 00 00 00") == "80 17 10 00 12 00 07 06");
  // Not announced: what the object takes.
  bench.sdo("C0 17 10 00 00 00 00 00");
  bench.sdo("81 E8 00 00 00 00 00 00");
  CHECK(bench.sdo("D9 00 00 00 00 00 00 00") == "80 17 10 00 13 00 07 06");
  CHECK(value_of_1017(bench) == unchanged_1017);
  // Nothing at all is a string, too.
  CHECK(bench.sdo("C6 06 20 00 00 00 00 00") == "A4 06 20 00 7F 00 00 00");
  CHECK(bench.sdo("81 FF FF FF FF FF FF FF") == "A2 01 7F 00 00 00 00 00");
  CHECK(bench.sdo("DD 00 00 00 00 00 00 00") == "A1 00 00 00 00 00 00 00");
  CHECK(bench.sdo("40 06 20 00 00 00 00 00") == "41 06 20 00 00 00 00 00");
}

TEST_CASE("Access and limits are checked as in a normal download") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("C2 00 10 00 04 00 00 00") == "80 00 10 00 02 00 01 06");
  CHECK(bench.sdo("C2 FF FF 00 04 00 00 00") == "80 FF FF 00 00 00 02 06");
  CHECK(bench.sdo("C2 18 10 FE 04 00 00 00") == "80 18 10 FE 11 00 09 06");
  bench.sdo("C2 02 20 01 01 00 00 00");
  bench.sdo("81 C9 00 00 00 00 00 00");
  CHECK(bench.sdo("D9 00 00 00 00 00 00 00") == "80 02 20 01 31 00 09 06");
}

TEST_CASE("A client abort ends a block download without a word") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("C2 17 10 00 02 00 00 00");
  CHECK(bench.sdo("80 17 10 00 00 00 00 08") == "");
  CHECK(value_of_1017(bench) == unchanged_1017);
  bench.sdo("C2 17 10 00 02 00 00 00");
  bench.sdo("81 E8 03 00 00 00 00 00");
  CHECK(bench.sdo("80 17 10 00 00 00 00 08") == "");
  CHECK(bench.sdo("D5 00 00 00 00 00 00 00") == "80 00 00 00 01 00 04 05");
  CHECK(value_of_1017(bench) == unchanged_1017);
}

TEST_CASE("Between the last segment and the end a wrong command is refused, a new request is served") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("C2 17 10 00 02 00 00 00");
  bench.sdo("81 E8 03 00 00 00 00 00");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "80 17 10 00 01 00 04 05");
  bench.sdo("C2 17 10 00 02 00 00 00");
  bench.sdo("81 E8 03 00 00 00 00 00");
  CHECK(bench.sdo("40 00 10 00 00 00 00 00") == "43 00 10 00 91 01 0F 00");
  CHECK(bench.sdo("D5 00 00 00 00 00 00 00") == "80 00 00 00 01 00 04 05");
  CHECK(value_of_1017(bench) == unchanged_1017);
}

TEST_CASE("An abandoned block download is ended by the server") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("C2 17 10 00 02 00 00 00");
  CHECK(bench.wait(10s) == Frames{"585: 80 17 10 00 00 00 04 05"});
  CHECK(bench.sdo("2B 17 10 00 E8 03 00 00") == "60 17 10 00 00 00 00 00");
}
