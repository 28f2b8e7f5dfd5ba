// SPDX-License-Identifier: Apache-2.0
// PDO parameters and traffic (CiA 301, 7.2.2 and 7.5.2.35 to 7.5.2.38).
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {
const std::string done1800 = "60 00 18 01 00 00 00 00";
}

TEST_CASE("An event-driven RPDO takes effect at once, in Operational only") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 00 14 01 00 00 00 00") == "43 00 14 01 05 02 00 00");
  bench.send("205: 11 22 33 44");
  CHECK(bench.sdo("40 00 62 01 00 00 00 00") == "4F 00 62 01 00 00 00 00");
  bench.send("000: 01 05");
  CHECK(bench.send("205: 11 22 33 44") == Frames{"185: 11 22 33 44"});
  CHECK(bench.sdo("40 00 62 02 00 00 00 00") == "4F 00 62 02 22 00 00 00");
  CHECK(bench.sdo("40 11 64 01 00 00 00 00") == "4B 11 64 01 33 44 00 00");
}

TEST_CASE("An RPDO of the wrong length is dropped or cut") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2F 00 18 02 01 00 00 00");
  bench.send("000: 01 05");
  CHECK(bench.send("205: 11 22 33") == Frames{"085: 10 82 11 03 02 00 00 00"});
  CHECK(bench.send("205:").empty());
  CHECK(bench.sdo("40 00 62 01 00 00 00 00") == "4F 00 62 01 00 00 00 00");
  CHECK(bench.send("205: 11 22 33 44 55") == Frames{"085: 00 00 00 00 02 00 00 00"});
  CHECK(bench.sdo("40 00 62 01 00 00 00 00") == "4F 00 62 01 11 00 00 00");
}

TEST_CASE("A synchronous RPDO waits for the SYNC") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("2F 00 14 02 01 00 00 00") == "60 00 14 02 00 00 00 00");
  bench.sdo("2F 00 18 02 01 00 00 00");
  bench.send("000: 01 05\n205: 01 02 03 04\n205: 05 06 07 08");
  CHECK(bench.sdo("40 00 62 01 00 00 00 00") == "4F 00 62 01 00 00 00 00");
  CHECK(bench.send("080:") == Frames{"185: 05 06 07 08"});
}

TEST_CASE("The event timer of an RPDO is a deadline from the first one on") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2B 00 14 05 C8 00 00 00");
  bench.send("000: 01 05");
  CHECK(bench.wait(1s).empty());
  bench.send("205: 00 00 00 00");
  CHECK(bench.wait(1s, true) == Frames{"@1300 085: 50 82 11 00 02 00 00 00"});
  CHECK(bench.send("205: 00 00 00 00") == Frames{"085: 00 00 00 00 02 00 00 00"});
}

TEST_CASE("Synchronous TPDOs follow every n-th SYNC, type 00h only after a change") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2F 00 18 02 03 00 00 00");
  CHECK(bench.send("080:\n080:\n080:").empty());
  bench.send("000: 01 05");
  CHECK(bench.send("080:\n080:").empty());
  CHECK(bench.send("080:") == Frames{"185: 00 00 00 00"});
  CHECK(bench.send("080:\n080:\n080:\n080:") == Frames{"185: 00 00 00 00"});
  bench.sdo("2F 00 18 02 00 00 00 00");
  CHECK(bench.send("080:\n080:").empty());
  bench.sdo("2F 00 62 01 AA 00 00 00");
  CHECK(bench.send("080:\n080:") == Frames{"185: AA 00 00 00"});
}

TEST_CASE("Event timer and inhibit time bound the distance of event-driven TPDOs") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2B 00 18 05 64 00 00 00");
  bench.send("000: 01 05");
  CHECK(bench.wait(250ms, true) == Frames{"@200 185: 00 00 00 00", "@300 185: 00 00 00 00"});
  CHECK(bench.sdo("2B 00 18 03 D0 07 00 00") == "80 00 18 03 30 00 09 06");
  CHECK(bench.sdo("23 00 18 01 85 01 00 C0") == done1800);
  CHECK(bench.sdo("2B 00 18 03 D0 07 00 00") == "60 00 18 03 00 00 00 00");
  CHECK(bench.sdo("2B 00 18 05 00 00 00 00") == "60 00 18 05 00 00 00 00");
  CHECK(bench.sdo("23 00 18 01 85 01 00 40") == done1800);
  CHECK(bench.send("605: 2F 00 62 01 01 00 00 00") ==
        Frames{"185: 01 00 00 00", "585: 60 00 62 01 00 00 00 00"});
  CHECK(bench.sdo("2F 00 62 01 02 00 00 00") == "60 00 62 01 00 00 00 00");
  CHECK(bench.wait(1s, true) == Frames{"@550 185: 02 00 00 00"});
}

TEST_CASE("Remote frames are answered where bit 30 allows it") {
  Bench bench;
  bench.wait(100ms);
  bench.send("000: 01 05");
  const auto ask = [&] {
    bench.send(conform::can::remote_frame(conform::CanId(0x185), 4));
    return bench.take();
  };
  CHECK(ask().empty());
  bench.sdo("23 00 18 01 85 01 00 80");
  bench.sdo("2F 00 18 02 FC 00 00 00");
  bench.sdo("23 00 18 01 85 01 00 00");
  CHECK(bench.send("080:").empty());
  bench.sdo("2F 00 62 01 07 00 00 00");
  CHECK(ask() == Frames{"185: 00 00 00 00"});
  CHECK(bench.send("080:").empty());
  CHECK(ask() == Frames{"185: 07 00 00 00"});
  bench.send("000: 80 05");
  CHECK(ask().empty());
}

TEST_CASE("COB-IDs of PDOs are moved by way of not valid") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("23 00 18 01 A0 06 00 40") == "80 00 18 01 30 00 09 06");
  CHECK(bench.sdo("23 00 18 01 85 01 00 C0") == done1800);
  CHECK(bench.sdo("23 00 18 01 85 01 00 E0") == "80 00 18 01 30 00 09 06");
  CHECK(bench.sdo("23 00 18 01 A0 06 00 C0") == done1800);
  CHECK(bench.sdo("23 00 18 01 A0 06 00 40") == done1800);
  CHECK(bench.sdo("23 00 14 01 05 02 00 80") == "60 00 14 01 00 00 00 00");
  CHECK(bench.sdo("23 00 14 01 A1 06 00 80") == "60 00 14 01 00 00 00 00");
  CHECK(bench.sdo("23 00 14 01 A1 06 00 00") == "60 00 14 01 00 00 00 00");
  bench.send("000: 01 05");
  CHECK(bench.send("205: 11 22 33 44").empty());
  CHECK(bench.send("6A1: 11 00 00 00") == Frames{"6A0: 11 00 00 00"});
}

TEST_CASE("Transmission types that are reserved are refused") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("2F 00 14 02 F1 00 00 00") == "80 00 14 02 30 00 09 06");
  CHECK(bench.sdo("2F 00 14 02 FD 00 00 00") == "80 00 14 02 30 00 09 06");
  CHECK(bench.sdo("2F 00 18 02 FB 00 00 00") == "80 00 18 02 30 00 09 06");
  CHECK(bench.sdo("2F 00 18 02 FD 00 00 00") == "60 00 18 02 00 00 00 00");
  CHECK(bench.sdo("2F 00 18 02 F0 00 00 00") == "60 00 18 02 00 00 00 00");
  CHECK(bench.sdo("40 00 18 04 00 00 00 00") == "80 00 18 04 11 00 09 06");
}

TEST_CASE("A mapping is changed by the procedure of the standard and refused otherwise") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("2F 00 1A 00 00 00 00 00") == "80 00 1A 00 00 00 01 06");
  CHECK(bench.sdo("23 00 18 01 85 01 00 C0") == done1800);
  CHECK(bench.sdo("23 00 1A 01 10 02 01 64") == "80 00 1A 01 00 00 01 06");
  CHECK(bench.sdo("2F 00 1A 00 00 00 00 00") == "60 00 1A 00 00 00 00 00");
  CHECK(bench.sdo("23 00 1A 01 08 00 FF 5F") == "80 00 1A 01 00 00 02 06");
  CHECK(bench.sdo("23 00 1A 01 20 FE 18 10") == "80 00 1A 01 00 00 02 06");
  CHECK(bench.sdo("23 00 1A 01 20 00 00 10") == "80 00 1A 01 41 00 04 06");
  CHECK(bench.sdo("23 00 1A 01 08 01 00 62") == "80 00 1A 01 41 00 04 06");
  CHECK(bench.sdo("23 00 1A 01 10 01 00 60") == "80 00 1A 01 41 00 04 06");
  CHECK(bench.sdo("23 00 1A 01 10 02 01 64") == "60 00 1A 01 00 00 00 00");
  CHECK(bench.sdo("23 00 1A 02 08 03 00 60") == "60 00 1A 02 00 00 00 00");
  CHECK(bench.sdo("2F 00 1A 00 41 00 00 00") == "80 00 1A 00 42 00 04 06");
  CHECK(bench.sdo("2F 00 1A 00 04 00 00 00") == "80 00 1A 00 41 00 04 06");  // entry 04h is unused
  CHECK(bench.sdo("40 00 1A 00 00 00 00 00") == "4F 00 1A 00 00 00 00 00");
  CHECK(bench.sdo("2F 00 1A 00 02 00 00 00") == "60 00 1A 00 00 00 00 00");
  CHECK(bench.sdo("23 00 18 01 85 01 00 40") == done1800);
  bench.send("000: 01 05");
  CHECK(bench.send("605: 2B 11 64 02 34 12 00 00") ==
        Frames{"185: 34 12 00", "285: 34 12 00", "585: 60 11 64 02 00 00 00 00"});
}

TEST_CASE("A mapping of more than 64 bits is refused, placeholders are not") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("23 00 14 01 05 02 00 80");
  bench.sdo("2F 00 16 00 00 00 00 00");
  for (const char* sub : {"01", "02", "03"}) {
    CHECK(bench.sdo("23 00 16 " + std::string(sub) + " 20 00 07 00").starts_with("60"));
  }
  CHECK(bench.sdo("2F 00 16 00 03 00 00 00") == "80 00 16 00 42 00 04 06");
  CHECK(bench.sdo("23 00 16 01 08 00 05 00") == "60 00 16 01 00 00 00 00");
  CHECK(bench.sdo("23 00 16 02 08 01 00 62") == "60 00 16 02 00 00 00 00");
  CHECK(bench.sdo("23 00 16 01 01 00 01 00") == "80 00 16 01 00 00 02 06");
  CHECK(bench.sdo("2F 00 16 00 02 00 00 00") == "60 00 16 00 00 00 00 00");
  CHECK(bench.sdo("23 00 14 01 05 02 00 00") == "60 00 14 01 00 00 00 00");
  bench.send("000: 01 05\n205: 55 66");
  CHECK(bench.sdo("40 00 62 01 00 00 00 00") == "4F 00 62 01 66 00 00 00");
}
