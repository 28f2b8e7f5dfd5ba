// SPDX-License-Identifier: Apache-2.0
// Several PDOs side by side, the SYNC start value, eight mapped objects, and deadlines (CiA 301, 7.5.2.35 to
// 7.5.2.38).
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

TEST_CASE("Each RPDO has objects of its own, and each TPDO the inputs that repeat them") {
  Bench bench;
  bench.wait(100ms);
  bench.send("000: 01 05");
  CHECK(bench.send("305: 11 22 33") == Frames{"285: 11 22 33"});
  CHECK(bench.send("405: 44 55 66 77 88") == Frames{"385: 44 55 66 77 88"});
  CHECK(bench.send("505: 01 23 45 67") == Frames{"485: 01 23 45 67"});
  CHECK(bench.sdo("40 11 64 02 00 00 00 00") == "4B 11 64 02 11 22 00 00");
  CHECK(bench.sdo("40 00 62 08 00 00 00 00") == "4F 00 62 08 67 00 00 00");
}

TEST_CASE("Synchronous RPDOs keep their data apart until the SYNC") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2F 01 14 02 00 00 00 00");
  bench.sdo("2F 03 14 02 F0 00 00 00");
  bench.send("000: 01 05");
  CHECK(bench.send("305: 11 22 33\n505: 01 23 45 67").empty());
  CHECK(bench.send("080:") == Frames{"285: 11 22 33", "485: 01 23 45 67"});
  CHECK(bench.send("080:").empty());
}

TEST_CASE("One change sends every TPDO that carries the object, and one SYNC all synchronous ones") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("23 03 18 01 85 04 00 C0");
  bench.sdo("2F 03 1A 00 00 00 00 00");
  bench.sdo("23 03 1A 01 08 01 00 60");
  bench.sdo("2F 03 1A 00 01 00 00 00");
  bench.sdo("23 03 18 01 85 04 00 40");
  bench.send("000: 01 05");
  CHECK(bench.send("605: 2F 00 62 01 80 00 00 00") ==
        Frames{"185: 80 00 00 00", "485: 80", "585: 60 00 62 01 00 00 00 00"});
  bench.sdo("2F 00 18 02 01 00 00 00");
  bench.sdo("2F 03 18 02 01 00 00 00");
  CHECK(bench.send("080:") == Frames{"185: 80 00 00 00", "485: 80"});
}

TEST_CASE("Eight objects can be mapped, nine bytes cannot") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("23 02 18 01 85 03 00 C0");
  bench.sdo("2F 02 1A 00 00 00 00 00");
  for (const char* sub : {"01", "02", "03", "04", "05", "06", "07", "08"}) {
    CHECK(bench.sdo("23 02 1A " + std::string(sub) + " 08 " + sub + " 00 60").starts_with("60"));
  }
  CHECK(bench.sdo("2F 02 1A 00 09 00 00 00") == "80 02 1A 00 42 00 04 06");
  CHECK(bench.sdo("2F 02 1A 00 08 00 00 00") == "60 02 1A 00 00 00 00 00");
  bench.sdo("23 02 1A 08 10 01 01 64");
  CHECK(bench.sdo("40 02 1A 08 00 00 00 00") == "43 02 1A 08 08 08 00 60");  // locked while it is enabled
  bench.sdo("2F 02 18 02 01 00 00 00");
  bench.sdo("23 02 18 01 85 03 00 40");
  bench.sdo("2F 00 62 08 EF 00 00 00");
  bench.sdo("2F 00 62 01 12 00 00 00");
  bench.send("000: 01 05");
  CHECK(bench.send("080:") == Frames{"385: 12 00 00 00 00 00 00 EF"});
}

TEST_CASE("A cyclic TPDO begins with the SYNC of its start value, where SYNCs are counted") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2F 19 10 00 0A 00 00 00");
  bench.sdo("2F 00 18 02 03 00 00 00");
  CHECK(bench.sdo("2F 00 18 06 04 00 00 00") == "80 00 18 06 30 00 09 06");
  bench.sdo("23 00 18 01 85 01 00 C0");
  CHECK(bench.sdo("2F 00 18 06 F1 00 00 00") == "80 00 18 06 30 00 09 06");
  CHECK(bench.sdo("2F 00 18 06 04 00 00 00") == "60 00 18 06 00 00 00 00");
  bench.sdo("23 00 18 01 85 01 00 40");
  bench.send("000: 01 05");
  CHECK(bench.send("080: 08\n080: 09\n080: 0A\n080: 01\n080: 02\n080: 03").empty());
  CHECK(bench.send("080: 04") == Frames{"185: 00 00 00 00"});
  CHECK(bench.send("080: 05\n080: 06").empty());
  CHECK(bench.send("080: 07") == Frames{"185: 00 00 00 00"});
}

TEST_CASE("Where SYNCs are not counted the start value means nothing") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2F 00 18 02 01 00 00 00");
  bench.sdo("23 00 18 01 85 01 00 C0");
  bench.sdo("2F 00 18 06 04 00 00 00");
  bench.sdo("23 00 18 01 85 01 00 40");
  bench.send("000: 01 05");
  CHECK(bench.send("080:") == Frames{"185: 00 00 00 00"});
}

TEST_CASE("Type FDh sends on remote request only, and not while the TPDO is not valid") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("23 01 18 01 85 02 00 80");
  bench.sdo("2F 01 18 02 FD 00 00 00");
  bench.sdo("2B 01 18 05 32 00 00 00");
  bench.send("000: 01 05");
  const auto ask = [&] {
    bench.send(conform::can::remote_frame(conform::CanId(0x285), 3));
    return bench.take();
  };
  CHECK(ask().empty());
  bench.sdo("23 01 18 01 85 02 00 00");
  bench.sdo("2F 00 62 03 81 00 00 00");
  CHECK(bench.wait(500ms).empty());
  CHECK(ask() == Frames{"285: 00 00 81"});
}

TEST_CASE("Every deadline of an RPDO is told by itself, and again") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2B 01 14 05 64 00 00 00");
  bench.sdo("2B 03 14 05 64 00 00 00");
  for (const char* tpdo : {"01", "03"}) bench.sdo("2F " + std::string(tpdo) + " 18 02 01 00 00 00");
  bench.send("000: 01 05\n305: 00 00 00\n505: 00 00 00 00");
  CHECK(bench.wait(200ms) == Frames{"085: 50 82 11 00 02 00 00 00", "085: 50 82 11 00 02 00 00 00"});
  bench.send("305: 00 00 00");
  CHECK(bench.wait(200ms).size() == 1);
}
