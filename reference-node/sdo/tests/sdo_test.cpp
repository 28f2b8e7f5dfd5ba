// SPDX-License-Identifier: Apache-2.0
// The SDO server as bytes on the wire (CiA 301, 7.2.4.3).
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

TEST_CASE("An expedited upload tells how many bytes it carries") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 00 20 05 00 00 00 00") == "4F 00 20 05 12 00 00 00");
  CHECK(bench.sdo("40 00 20 06 00 00 00 00") == "4B 00 20 06 34 12 00 00");
  CHECK(bench.sdo("40 00 20 16 00 00 00 00") == "47 00 20 16 56 34 12 00");
  CHECK(bench.sdo("40 00 20 07 00 00 00 00") == "43 00 20 07 78 56 34 12");
  // Reserved bits and bytes of the request change nothing.
  CHECK(bench.sdo("5F 00 20 07 FF FF FF FF") == "43 00 20 07 78 56 34 12");
}

TEST_CASE("An expedited download is taken with and without size") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("2B 17 10 00 E8 03 FF FF") == "60 17 10 00 00 00 00 00");
  CHECK(bench.sdo("40 17 10 00 00 00 00 00") == "4B 17 10 00 E8 03 00 00");
  CHECK(bench.sdo("22 17 10 00 D0 07 5A A5") == "60 17 10 00 00 00 00 00");
  CHECK(bench.sdo("40 17 10 00 00 00 00 00") == "4B 17 10 00 D0 07 00 00");
  CHECK(bench.sdo("22 07 20 00 01 02 03 04") == "60 07 20 00 00 00 00 00");
  CHECK(bench.sdo("40 07 20 00 00 00 00 00") == "43 07 20 00 01 02 03 04");
  CHECK(bench.sdo("27 00 20 16 01 02 03 FF") == "60 00 20 16 00 00 00 00");
  CHECK(bench.sdo("40 00 20 16 00 00 00 00") == "47 00 20 16 01 02 03 00");
}

TEST_CASE("A long object is uploaded in segments with alternating toggle") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 08 10 00 00 00 00 00") == "41 08 10 00 0F 00 00 00");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "00 63 61 6E 6F 70 65 6E");
  CHECK(bench.sdo("70 00 00 00 00 00 00 00") == "10 2D 72 65 66 6E 6F 64");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "0D 65 00 00 00 00 00 00");
  CHECK(bench.sdo("70 00 00 00 00 00 00 00") == "80 00 00 00 01 00 04 05");
  // Seven bytes fit exactly; an empty string is one segment without data.
  CHECK(bench.sdo("40 05 20 08 00 00 00 00") == "41 05 20 08 07 00 00 00");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "01 61 62 63 64 65 66 67");
  CHECK(bench.sdo("40 05 20 01 00 00 00 00") == "41 05 20 01 00 00 00 00");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "0F 00 00 00 00 00 00 00");
}

TEST_CASE("A segmented download is stored when its last segment has come") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("21 06 20 00 09 00 00 00") == "60 06 20 00 00 00 00 00");
  CHECK(bench.sdo("00 41 42 43 44 45 46 47") == "20 00 00 00 00 00 00 00");
  CHECK(bench.sdo("1B 48 49 FF FF FF FF FF") == "30 00 00 00 00 00 00 00");
  CHECK(bench.sdo("40 06 20 00 00 00 00 00") == "41 06 20 00 09 00 00 00");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "00 41 42 43 44 45 46 47");
  CHECK(bench.sdo("70 00 00 00 00 00 00 00") == "1B 48 49 00 00 00 00 00");
  // Without size, for a number, and a middle segment that is not full.
  CHECK(bench.sdo("20 17 10 00 00 00 00 00") == "60 17 10 00 00 00 00 00");
  CHECK(bench.sdo("0B E8 03 00 00 00 00 00") == "20 00 00 00 00 00 00 00");
  CHECK(bench.sdo("40 17 10 00 00 00 00 00") == "4B 17 10 00 E8 03 00 00");
  CHECK(bench.sdo("21 06 20 00 06 00 00 00") == "60 06 20 00 00 00 00 00");
  CHECK(bench.sdo("06 61 62 63 64 00 00 00") == "20 00 00 00 00 00 00 00");
  CHECK(bench.sdo("1B 65 66 00 00 00 00 00") == "30 00 00 00 00 00 00 00");
  CHECK(bench.sdo("40 06 20 00 00 00 00 00") == "41 06 20 00 06 00 00 00");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "03 61 62 63 64 65 66 00");
}

TEST_CASE("A toggle error aborts and closes the transfer") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 08 10 00 00 00 00 00") == "41 08 10 00 0F 00 00 00");
  CHECK(bench.sdo("70 00 00 00 00 00 00 00") == "80 08 10 00 00 00 03 05");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "80 00 00 00 01 00 04 05");
  CHECK(bench.sdo("21 17 10 00 02 00 00 00") == "60 17 10 00 00 00 00 00");
  CHECK(bench.sdo("1B E8 03 00 00 00 00 00") == "80 17 10 00 00 00 03 05");
  CHECK(bench.sdo("40 17 10 00 00 00 00 00") == "4B 17 10 00 00 00 00 00");
}

TEST_CASE("Segments of the wrong kind or without a transfer are refused") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("01 00 00 00 00 00 00 00") == "80 00 00 00 01 00 04 05");
  CHECK(bench.sdo("40 08 10 00 00 00 00 00") == "41 08 10 00 0F 00 00 00");
  CHECK(bench.sdo("01 00 00 00 00 00 00 00") == "80 08 10 00 01 00 04 05");
  CHECK(bench.sdo("21 17 10 00 02 00 00 00") == "60 17 10 00 00 00 00 00");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "80 17 10 00 01 00 04 05");
}

TEST_CASE("The length of a download must fit the object and the announcement") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("23 17 10 00 E8 03 00 00") == "80 17 10 00 12 00 07 06");
  CHECK(bench.sdo("2F 17 10 00 01 00 00 00") == "80 17 10 00 13 00 07 06");
  CHECK(bench.sdo("23 00 20 1B 01 02 03 04") == "80 00 20 1B 13 00 07 06");
  CHECK(bench.sdo("21 17 10 00 03 00 00 00") == "80 17 10 00 12 00 07 06");
  CHECK(bench.sdo("21 17 10 00 01 00 00 00") == "80 17 10 00 13 00 07 06");
  CHECK(bench.sdo("21 17 10 00 02 00 00 00") == "60 17 10 00 00 00 00 00");
  CHECK(bench.sdo("0D E8 00 00 00 00 00 00") == "80 17 10 00 13 00 07 06");
  CHECK(bench.sdo("21 17 10 00 02 00 00 00") == "60 17 10 00 00 00 00 00");
  CHECK(bench.sdo("00 E8 03 00 00 00 00 00") == "80 17 10 00 12 00 07 06");
  CHECK(bench.sdo("20 17 10 00 00 00 00 00") == "60 17 10 00 00 00 00 00");
  CHECK(bench.sdo("0F 00 00 00 00 00 00 00") == "80 17 10 00 13 00 07 06");
  CHECK(bench.sdo("2F 00 20 0B 41 00 00 00") == "80 00 20 0B 10 00 07 06");
  CHECK(bench.sdo("40 17 10 00 00 00 00 00") == "4B 17 10 00 00 00 00 00");
}

TEST_CASE("Access rights, existence and limits have their abort codes") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 04 10 00 00 00 00 00") == "80 04 10 00 00 00 02 06");
  CHECK(bench.sdo("40 18 10 05 00 00 00 00") == "80 18 10 05 11 00 09 06");
  CHECK(bench.sdo("40 03 20 03 00 00 00 00") == "80 03 20 03 11 00 09 06");
  CHECK(bench.sdo("2F 01 10 00 00 00 00 00") == "80 01 10 00 02 00 01 06");
  CHECK(bench.sdo("2F 18 10 00 04 00 00 00") == "80 18 10 00 02 00 01 06");
  CHECK(bench.sdo("21 00 10 00 04 00 00 00") == "80 00 10 00 02 00 01 06");
  CHECK(bench.sdo("40 01 20 02 00 00 00 00") == "80 01 20 02 01 00 01 06");
  CHECK(bench.sdo("2B 01 20 02 01 00 00 00") == "60 01 20 02 00 00 00 00");
  CHECK(bench.sdo("2F 02 20 01 C9 00 00 00") == "80 02 20 01 31 00 09 06");
  CHECK(bench.sdo("2F 02 20 01 09 00 00 00") == "80 02 20 01 32 00 09 06");
  CHECK(bench.sdo("2F 02 20 01 C8 00 00 00") == "60 02 20 01 00 00 00 00");
  CHECK(bench.sdo("2B 02 20 02 E9 03 00 00") == "80 02 20 02 31 00 09 06");
  CHECK(bench.sdo("2B 02 20 02 17 FC 00 00") == "80 02 20 02 32 00 09 06");
  CHECK(bench.sdo("2B 02 20 02 18 FC 00 00") == "60 02 20 02 00 00 00 00");
  CHECK(bench.sdo("2F 00 20 01 02 00 00 00") == "80 00 20 01 31 00 09 06");
}

TEST_CASE("Unknown commands are refused, a client abort is not answered") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("E0 00 10 00 00 00 00 00") == "80 00 10 00 01 00 04 05");
  CHECK(bench.sdo("80 00 10 00 00 00 00 08") == "");
  CHECK(bench.sdo("21 17 10 00 02 00 00 00") == "60 17 10 00 00 00 00 00");
  CHECK(bench.sdo("80 17 10 00 00 00 00 08") == "");
  CHECK(bench.sdo("0B E8 03 00 00 00 00 00") == "80 00 00 00 01 00 04 05");
}

TEST_CASE("A new initiate replaces the running transfer") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 08 10 00 00 00 00 00") == "41 08 10 00 0F 00 00 00");
  CHECK(bench.sdo("2B 17 10 00 E8 03 00 00") == "60 17 10 00 00 00 00 00");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "80 00 00 00 01 00 04 05");
}

TEST_CASE("Only whole requests on the own CAN-ID count") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 00 10 00 00 00 00") == "");
  CHECK(bench.send("600: 40 00 10 00 00 00 00 00").empty());
  CHECK(bench.send("606: 40 00 10 00 00 00 00 00").empty());
  CHECK(bench.send("585: 40 00 10 00 00 00 00 00").empty());
  bench.send(conform::can::remote_frame(conform::CanId(0x605), 8));
  auto extended = conform::can::data_frame(conform::CanId(0x605), {0x40, 0, 0x10, 0, 0, 0, 0, 0});
  extended.extended = true;
  bench.send(extended);
  CHECK(bench.take().empty());
}

TEST_CASE("The server is silent in Stopped and forgets its transfer") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 08 10 00 00 00 00 00") == "41 08 10 00 0F 00 00 00");
  bench.send("000: 02 05");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "");
  CHECK(bench.sdo("2B 17 10 00 E8 03 00 00") == "");
  bench.send("000: 80 05");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "80 00 00 00 01 00 04 05");
  CHECK(bench.sdo("40 17 10 00 00 00 00 00") == "4B 17 10 00 00 00 00 00");
}

TEST_CASE("A response can be given a turnaround time") {
  Options options;
  options.node_id = 5;
  options.adjust = [](Parts& parts) { parts.sdo.choices.turnaround = 2ms; };
  auto made = Node::create(options);
  REQUIRE(made.has_value());
  int sent = 0;
  (*made)->attach([&](const conform::can::Frame&) { ++sent; }, conform::BusTime{});
  (*made)->on_time(conform::BusTime{100ms});
  CHECK(sent == 1);
  (*made)->on_frame(conform::can::data_frame(conform::CanId(0x605), {0x40, 0, 0x10, 0, 0, 0, 0, 0}),
                    conform::BusTime{200ms});
  CHECK(sent == 1);
  CHECK((*made)->next_wakeup() == conform::BusTime{202ms});
  (*made)->on_time(conform::BusTime{202ms});
  CHECK(sent == 2);
}
