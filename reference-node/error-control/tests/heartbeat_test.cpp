// SPDX-License-Identifier: Apache-2.0
// Heartbeat, producer and consumer (CiA 301, 7.2.8).
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

TEST_CASE("The heartbeat starts with the write, follows changes and stops at 0") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2B 17 10 00 C8 00 00 00");
  CHECK(bench.wait(600ms, true) == Frames{"@300 705: 7F", "@500 705: 7F", "@700 705: 7F"});
  bench.sdo("2B 17 10 00 64 00 00 00");
  CHECK(bench.wait(200ms, true) == Frames{"@800 705: 7F", "@900 705: 7F"});
  bench.sdo("2B 17 10 00 00 00 00 00");
  CHECK(bench.wait(5s).empty());
}

TEST_CASE("A stored heartbeat time counts from the boot-up message") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2B 17 10 00 F4 01 00 00");
  CHECK(bench.sdo("23 10 10 01 73 61 76 65") == "60 10 10 01 00 00 00 00");
  bench.send("000: 81 05");
  CHECK(bench.wait(1s, true) == Frames{"@120 705: 00", "@620 705: 7F"});
}

TEST_CASE("A heartbeat that crosses a reset is the next one, and none comes right behind another") {
  Bench bench(Bench::Wanted{{.node_id = 5, .variants = {"heartbeat-crosses-reset"}}});
  bench.wait(100ms);
  bench.sdo("2B 17 10 00 C8 00 00 00");
  CHECK(bench.sdo("23 10 10 01 73 61 76 65") == "60 10 10 01 00 00 00 00");
  bench.wait(350ms);
  CHECK(bench.send("000: 81 05") == Frames{"705: 7F"});
  bench.wait(20ms + 201ms);
  CHECK(bench.send("000: 81 05").empty());
}

TEST_CASE("A missing heartbeat is reported once, and its return as well") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("23 16 10 01 F4 01 7E 00") == "60 16 10 01 00 00 00 00");
  CHECK(bench.wait(3s).empty());  // nothing before the first heartbeat
  bench.send("77E: 05");
  CHECK(bench.wait(400ms).empty());
  bench.send("77E: 05");
  CHECK(bench.wait(499ms).empty());
  CHECK(bench.wait(1ms) == Frames{"085: 30 81 11 7E 01 00 00 00"});
  CHECK(bench.sdo("40 01 10 00 00 00 00 00") == "4F 01 10 00 11 00 00 00");
  CHECK(bench.wait(10s).empty());
  CHECK(bench.send("77E: 05") == Frames{"085: 00 00 00 00 01 00 00 00"});
  CHECK(bench.sdo("40 01 10 00 00 00 00 00") == "4F 01 10 00 00 00 00 00");
}

TEST_CASE("A heartbeat loss ends Operational, and every entry is watched by itself") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2B 17 10 00 E8 03 00 00");
  bench.sdo("23 16 10 01 64 00 7D 00");
  bench.sdo("23 16 10 02 C8 00 7E 00");
  bench.send("000: 01 05\n77D: 05\n77E: 05");
  CHECK(bench.wait(150ms) == Frames{"085: 30 81 11 7D 01 00 00 00"});
  CHECK(bench.wait(50ms) == Frames{"085: 30 81 11 7E 01 00 00 00"});
  CHECK(bench.wait(800ms) == Frames{"705: 7F"});
}

TEST_CASE("1016h refuses a second entry for one node and its reserved bits") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("23 16 10 01 E8 03 7E 00") == "60 16 10 01 00 00 00 00");
  CHECK(bench.sdo("23 16 10 02 D0 07 7E 00") == "80 16 10 02 43 00 04 06");
  CHECK(bench.sdo("23 16 10 02 00 00 7E 00") == "60 16 10 02 00 00 00 00");
  CHECK(bench.sdo("23 16 10 01 D0 07 7E 00") == "60 16 10 01 00 00 00 00");
  CHECK(bench.sdo("23 16 10 01 D0 07 7E 00") == "60 16 10 01 00 00 00 00");
  CHECK(bench.sdo("23 16 10 01 E8 03 7E 01") == "80 16 10 01 30 00 09 06");
  CHECK(bench.sdo("23 16 10 03 64 00 00 00") == "60 16 10 03 00 00 00 00");
  CHECK(bench.sdo("23 16 10 04 64 00 80 00") == "60 16 10 04 00 00 00 00");
  CHECK(bench.sdo("40 16 10 05 00 00 00 00") == "80 16 10 05 11 00 09 06");
}
