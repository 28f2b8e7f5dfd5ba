// SPDX-License-Identifier: Apache-2.0
// Block upload as bytes on the wire (CiA 301, 7.2.4.3.12 to 7.2.4.3.17).
#include "node/tests/bench.hpp"
#include "sdo/crc.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {

const Frames name_segments{"585: 01 63 61 6E 6F 70 65 6E", "585: 02 2D 72 65 66 6E 6F 64",
                           "585: 83 65 00 00 00 00 00 00"};
constexpr auto name_end = "D9 F5 C5 00 00 00 00 00";  // six bytes of the last segment unused
constexpr auto refused = "80 00 00 00 01 00 04 05";
constexpr auto refused_1008 = "80 08 10 00 01 00 04 05";

}  // namespace

TEST_CASE("The CRC is the one of the standard") {
  constexpr std::string_view digits = "123456789";
  const Bytes bytes(digits.begin(), digits.end());
  CHECK(sdo_crc(bytes) == 0x31C3);
  CHECK(sdo_crc(Bytes{0xE8, 0x03}) == 0xA978);
  CHECK(sdo_crc(conform::ByteView(bytes).subspan(4), sdo_crc(conform::ByteView(bytes).first(4))) == 0x31C3);
}

TEST_CASE("A block upload runs through initiate, start, sub-block, acknowledge and end") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("A4 08 10 00 14 00 00 00") == "C6 08 10 00 0F 00 00 00");
  CHECK(bench.wait(10ms).empty());  // nothing before the start
  CHECK(bench.send("605: A3 00 00 00 00 00 00 00") == name_segments);
  CHECK(bench.sdo("A2 03 14 00 00 00 00 00") == name_end);
  CHECK(bench.sdo("A1 00 00 00 00 00 00 00") == "");
  CHECK(bench.wait(5s).empty());
  CHECK(bench.sdo("40 00 10 00 00 00 00 00") == "43 00 10 00 91 01 0F 00");
}

TEST_CASE("Without agreement on the CRC its field is zero") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("A0 00 10 00 7F 00 00 00") == "C6 00 10 00 04 00 00 00");
  CHECK(bench.send("605: A3 00 00 00 00 00 00 00") == Frames{"585: 81 91 01 0F 00 00 00 00"});
  CHECK(bench.sdo("A2 01 7F 00 00 00 00 00") == "CD 00 00 00 00 00 00 00");
  bench.sdo("A1 00 00 00 00 00 00 00");
  // Reserved bits and bytes change nothing.
  CHECK(bench.sdo("B8 00 10 00 7F 00 FF FF") == "C6 00 10 00 04 00 00 00");
}

TEST_CASE("The block size is kept, changes with an acknowledge, and numbers start again with 1") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("A4 08 10 00 01 00 00 00") == "C6 08 10 00 0F 00 00 00");
  CHECK(bench.send("605: A3 00 00 00 00 00 00 00") == Frames{"585: 01 63 61 6E 6F 70 65 6E"});
  CHECK(bench.wait(100ms).empty());
  CHECK(bench.send("605: A2 01 02 00 00 00 00 00") ==
        Frames{"585: 01 2D 72 65 66 6E 6F 64", "585: 82 65 00 00 00 00 00 00"});
  CHECK(bench.sdo("A2 02 7F 00 00 00 00 00") == name_end);
}

TEST_CASE("What was not acknowledged is sent again and counts once in the CRC") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("A4 08 10 00 7F 00 00 00");
  bench.send("605: A3 00 00 00 00 00 00 00");
  CHECK(bench.send("605: A2 00 7F 00 00 00 00 00") == name_segments);
  CHECK(bench.send("605: A2 01 7F 00 00 00 00 00") ==
        Frames{"585: 01 2D 72 65 66 6E 6F 64", "585: 82 65 00 00 00 00 00 00"});
  CHECK(bench.sdo("A2 02 7F 00 00 00 00 00") == name_end);
}

TEST_CASE("A sub-block of 127 segments is followed by the rest") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("21 00 20 0F E8 03 00 00") == "60 00 20 0F 00 00 00 00");  // 1000 bytes
  for (int segment = 0; segment < 143; ++segment) {
    const bool last = segment == 142;
    const std::string command = std::string(segment % 2 == 0 ? "0" : "1") + (last ? "3" : "0");
    bench.sdo(command + " 01 02 03 04 05 06 07");
  }
  CHECK(bench.sdo("A0 00 20 0F 7F 00 00 00") == "C6 00 20 0F E8 03 00 00");
  auto first = bench.send("605: A3 00 00 00 00 00 00 00");
  CHECK(first.size() < 127);  // an abort or another command finds a gap
  const auto more = bench.wait(1ms);
  first.insert(first.end(), more.begin(), more.end());
  REQUIRE(first.size() == 127);
  CHECK(first[126] == "585: 7F 01 02 03 04 05 06 07");
  bench.send("605: A2 7F 7F 00 00 00 00 00");
  auto second = bench.wait(1ms);
  REQUIRE_FALSE(second.empty());
  CHECK(second.back() == "585: 90 01 02 03 04 05 06 00");
  CHECK(bench.sdo("A2 10 7F 00 00 00 00 00") == "C5 00 00 00 00 00 00 00");
}

TEST_CASE("Block sizes of 0 and above 127 are refused") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("A0 00 10 00 00 00 00 00") == "80 00 10 00 02 00 04 05");
  CHECK(bench.sdo("A0 00 10 00 80 00 00 00") == "80 00 10 00 02 00 04 05");
  for (const char* acknowledge : {"A2 01 00 00 00 00 00 00", "A2 01 80 00 00 00 00 00"}) {
    bench.sdo("A0 08 10 00 01 00 00 00");
    bench.send("605: A3 00 00 00 00 00 00 00");
    CHECK(bench.sdo(acknowledge) == "80 08 10 00 02 00 04 05");
    CHECK(bench.sdo("A2 01 01 00 00 00 00 00") == refused);
  }
}

TEST_CASE("An acknowledge of segments that were never sent is refused") {
  Bench bench;
  bench.wait(100ms);
  for (const char* acknowledge : {"A2 80 14 00 00 00 00 00", "A2 05 14 00 00 00 00 00"}) {
    bench.sdo("A0 00 10 00 14 00 00 00");
    bench.send("605: A3 00 00 00 00 00 00 00");
    CHECK(bench.sdo(acknowledge) == "80 00 10 00 03 00 04 05");
  }
}

TEST_CASE("Objects not larger than the threshold are uploaded by the normal protocol") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("A0 00 10 00 7F 04 00 00") == "43 00 10 00 91 01 0F 00");
  CHECK(bench.sdo("A0 00 10 00 7F 03 00 00") == "C6 00 10 00 04 00 00 00");
  CHECK(bench.sdo("A0 08 10 00 7F FF 00 00") == "41 08 10 00 0F 00 00 00");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "00 63 61 6E 6F 70 65 6E");
}

TEST_CASE("An empty object is one segment without data") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("A4 05 20 01 7F 00 00 00") == "C6 05 20 01 00 00 00 00");
  CHECK(bench.send("605: A3 00 00 00 00 00 00 00") == Frames{"585: 81 00 00 00 00 00 00 00"});
  CHECK(bench.sdo("A2 01 7F 00 00 00 00 00") == "DD 00 00 00 00 00 00 00");
}

TEST_CASE("Access errors of a block upload are those of a normal one") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("A0 FF FF 00 14 00 00 00") == "80 FF FF 00 00 00 02 06");
  CHECK(bench.sdo("A0 18 10 FE 14 00 00 00") == "80 18 10 FE 11 00 09 06");
  CHECK(bench.sdo("A0 01 20 02 14 00 00 00") == "80 01 20 02 01 00 01 06");
}

TEST_CASE("Commands that do not fit a block upload are refused and end it") {
  Bench bench;
  bench.wait(100ms);
  for (const char* command :
       {"A3 00 00 00 00 00 00 00", "A2 01 14 00 00 00 00 00", "A1 00 00 00 00 00 00 00"})
    CHECK(bench.sdo(command) == refused);
  for (const char* command : {"60 00 00 00 00 00 00 00", "A2 00 14 00 00 00 00 00", "A1 00 00 00 00 00 00 00",
                              "C1 00 00 00 00 00 00 00", "00 00 00 00 00 00 00 00"}) {
    bench.sdo("A0 08 10 00 14 00 00 00");
    CHECK(bench.sdo(command) == refused_1008);
    CHECK(bench.sdo("A3 00 00 00 00 00 00 00") == refused);
  }
}

TEST_CASE("An abort, a new request or stopping the node ends a sub-block on its way") {
  Bench bench;
  bench.wait(100ms);
  const auto running = [&] {
    bench.sdo("A0 00 20 0F 7F 00 00 00");  // 256 bytes: 37 segments
    CHECK(bench.send("605: A3 00 00 00 00 00 00 00").size() == 8);
  };
  running();
  CHECK(bench.send("605: 80 00 20 0F 00 00 00 08").empty());
  CHECK(bench.wait(1s).empty());
  CHECK(bench.sdo("A3 00 00 00 00 00 00 00") == refused);
  running();
  CHECK(bench.sdo("40 00 10 00 00 00 00 00") == "43 00 10 00 91 01 0F 00");
  CHECK(bench.wait(1s).empty());
  running();
  CHECK(bench.send("000: 02 05").empty());
  CHECK(bench.wait(1s).empty());
}

TEST_CASE("A client that falls silent is told so once") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("A0 08 10 00 01 00 00 00");
  bench.send("605: A3 00 00 00 00 00 00 00");
  CHECK(bench.wait(999ms).empty());
  CHECK(bench.wait(10s) == Frames{"585: 80 08 10 00 00 00 04 05"});
  CHECK(bench.sdo("A2 01 01 00 00 00 00 00") == refused);
}

TEST_CASE("The server may lack block transfer, the CRC or the size, or never switch the protocol") {
  const auto answer = [](auto choose, std::string_view request) {
    SdoChoices choices;
    choose(choices);
    Bench bench = Bench::choosing(choices);
    bench.wait(100ms);
    return bench.sdo(request);
  };
  CHECK(answer([](SdoChoices& c) { c.block = false; }, "A4 08 10 00 14 00 00 00") == refused_1008);
  CHECK(answer([](SdoChoices& c) { c.block = false; }, "C6 17 10 00 02 00 00 00") ==
        "80 17 10 00 01 00 04 05");
  CHECK(answer([](SdoChoices& c) { c.crc = false; }, "A4 08 10 00 14 00 00 00") == "C2 08 10 00 0F 00 00 00");
  CHECK(answer([](SdoChoices& c) { c.upload_size_indicated = false; }, "A4 08 10 00 14 00 00 00") ==
        "C4 08 10 00 00 00 00 00");
  CHECK(answer([](SdoChoices& c) { c.upload_size_indicated = false; }, "40 08 10 00 00 00 00 00") ==
        "40 08 10 00 00 00 00 00");
  CHECK(answer([](SdoChoices& c) { c.protocol_switch = false; }, "A4 00 10 00 14 04 00 00") ==
        "C6 00 10 00 04 00 00 00");
  CHECK(answer([](SdoChoices& c) { c.expedited_upload = false; }, "40 00 10 00 00 00 00 00") ==
        "41 00 10 00 04 00 00 00");
}
