// SPDX-License-Identifier: Apache-2.0
// Error register, EMCY and history, driven by the error trigger 2F00h (CiA 301, 7.2.7 and 7.5.2.4).
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {
const std::string raised = "585: 60 00 2F 01 00 00 00 00";
const std::string cleared = "585: 60 00 2F 02 00 00 00 00";
}  // namespace

TEST_CASE("The error trigger raises and clears errors, once each") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.send("605: 2B 00 2F 01 10 42 00 00") == Frames{"085: 10 42 09 00 00 00 00 00", raised});
  CHECK(bench.send("605: 2B 00 2F 01 10 42 00 00") == Frames{raised});
  CHECK(bench.send("605: 2B 00 2F 01 10 23 00 00") == Frames{"085: 10 23 0B 00 00 00 00 00", raised});
  CHECK(bench.sdo("40 01 10 00 00 00 00 00") == "4F 01 10 00 0B 00 00 00");
  CHECK(bench.sdo("40 00 2F 03 00 00 00 00") == "4F 00 2F 03 02 00 00 00");
  CHECK(bench.send("605: 2B 00 2F 02 10 42 00 00") == Frames{cleared});
  CHECK(bench.sdo("40 01 10 00 00 00 00 00") == "4F 01 10 00 03 00 00 00");
  CHECK(bench.send("605: 2B 00 2F 02 00 00 00 00") == Frames{"085: 00 00 00 00 00 00 00 00", cleared});
  CHECK(bench.sdo("2B 00 2F 01 00 00 00 00") == "80 00 2F 01 30 00 09 06");
  CHECK(bench.sdo("40 00 2F 01 00 00 00 00") == "80 00 2F 01 01 00 01 06");
}

TEST_CASE("The history holds the newest error first and only errors") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 03 10 00 00 00 00 00") == "4F 03 10 00 00 00 00 00");
  CHECK(bench.sdo("40 03 10 01 00 00 00 00") == "80 03 10 01 24 00 00 08");
  CHECK(bench.sdo("40 03 10 08 00 00 00 00") == "80 03 10 08 24 00 00 08");
  CHECK(bench.sdo("40 03 10 09 00 00 00 00") == "80 03 10 09 11 00 09 06");
  bench.send("605: 2B 00 2F 01 10 42 00 00\n605: 2B 00 2F 01 10 23 00 00\n605: 2B 00 2F 02 00 00 00 00");
  CHECK(bench.sdo("40 03 10 00 00 00 00 00") == "4F 03 10 00 02 00 00 00");
  CHECK(bench.sdo("40 03 10 01 00 00 00 00") == "43 03 10 01 10 23 00 00");
  CHECK(bench.sdo("40 03 10 02 00 00 00 00") == "43 03 10 02 10 42 00 00");
  CHECK(bench.sdo("40 03 10 03 00 00 00 00") == "80 03 10 03 24 00 00 08");
  CHECK(bench.sdo("23 03 10 01 00 00 00 00") == "80 03 10 01 02 00 01 06");
}

TEST_CASE("A full history drops the oldest error") {
  Bench bench;
  bench.wait(100ms);
  for (int i = 1; i <= 9; ++i) {
    bench.send("605: 2B 00 2F 01 0" + std::to_string(i) + " 50 00 00");
  }
  CHECK(bench.sdo("40 03 10 00 00 00 00 00") == "4F 03 10 00 08 00 00 00");
  CHECK(bench.sdo("40 03 10 01 00 00 00 00") == "43 03 10 01 09 50 00 00");
  CHECK(bench.sdo("40 03 10 08 00 00 00 00") == "43 03 10 08 02 50 00 00");
}

TEST_CASE("Only 00h clears the history, and it acknowledges nothing") {
  Bench bench;
  bench.wait(100ms);
  bench.send("605: 2B 00 2F 01 10 42 00 00");
  for (const char* value : {"01", "02", "FE", "FF"}) {
    CHECK(bench.sdo("2F 03 10 00 " + std::string(value) + " 00 00 00") == "80 03 10 00 30 00 09 06");
  }
  CHECK(bench.sdo("23 03 10 00 00 00 00 00") == "80 03 10 00 12 00 07 06");
  CHECK(bench.sdo("40 03 10 01 00 00 00 00") == "43 03 10 01 10 42 00 00");
  CHECK(bench.sdo("2F 03 10 00 00 00 00 00") == "60 03 10 00 00 00 00 00");
  CHECK(bench.sdo("40 03 10 00 00 00 00 00") == "4F 03 10 00 00 00 00 00");
  CHECK(bench.sdo("40 01 10 00 00 00 00 00") == "4F 01 10 00 09 00 00 00");
  CHECK(bench.sdo("2F 03 10 00 00 00 00 00") == "60 03 10 00 00 00 00 00");
}

TEST_CASE("The inhibit time of 1015h delays and loses nothing") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("2B 15 10 00 88 13 00 00") == "60 15 10 00 00 00 00 00");
  CHECK(bench.send(
            "605: 2B 00 2F 01 10 42 00 00\n605: 2B 00 2F 01 10 23 00 00\n605: 2B 00 2F 02 00 00 00 00") ==
        Frames{"085: 10 42 09 00 00 00 00 00", raised, raised, cleared});
  CHECK(bench.wait(2s, true) ==
        Frames{"@600 085: 10 23 0B 00 00 00 00 00", "@1100 085: 00 00 00 00 00 00 00 00"});
}

TEST_CASE("What waits for the inhibit time is dropped when 1014h becomes not valid") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("2B 15 10 00 88 13 00 00") == "60 15 10 00 00 00 00 00");
  bench.send("605: 2B 00 2F 01 10 42 00 00\n605: 2B 00 2F 01 10 23 00 00");
  CHECK(bench.sdo("23 14 10 00 85 00 00 80") == "60 14 10 00 00 00 00 00");
  CHECK(bench.wait(2s, true).empty());
}

TEST_CASE("EMCY is silent in Stopped and tells the latest state afterwards") {
  Bench bench;
  bench.wait(100ms);
  bench.send("605: 23 16 10 01 64 00 7D 00\n605: 23 16 10 02 C8 00 7E 00\n77D: 05\n77E: 05\n000: 02 05");
  CHECK(bench.wait(1s).empty());
  CHECK(bench.send("000: 80 05") == Frames{"085: 30 81 11 7E 01 00 00 00"});
  CHECK(bench.sdo("40 03 10 00 00 00 00 00") == "4F 03 10 00 02 00 00 00");
}

TEST_CASE("An error unheard of is not reset on the bus after Stopped") {
  Bench bench;
  bench.wait(100ms);
  bench.send("605: 23 16 10 01 64 00 7D 00\n77D: 05\n000: 02 05");
  CHECK(bench.wait(1s).empty());
  bench.send("77D: 05");
  CHECK(bench.send("000: 80 05").empty());
}

TEST_CASE("A SYNC with data is reported until one without data comes") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.send("080: 01") == Frames{"085: 40 82 11 01 03 00 00 00"});
  CHECK(bench.send("080: 01").empty());
  CHECK(bench.send("080:") == Frames{"085: 00 00 00 00 03 00 00 00"});
}

TEST_CASE("A node that tells of no error after its boot-up message is silent while it has one") {
  Bench bench(Bench::Wanted{{.node_id = 5, .variants = {"emcy-no-error-at-boot-up"}}});
  bench.wait(100ms);
  bench.send("000: 82 05");
  CHECK(bench.wait(100ms) == Frames{"705: 00", "085: 00 00 00 00 00 00 00 00"});
  bench.send("605: 2B 00 2F 01 00 70 00 00");
  bench.send("000: 82 05");
  CHECK(bench.wait(100ms) == Frames{"705: 00"});
  CHECK(bench.sdo("40 01 10 00 00 00 00 00") == "4F 01 10 00 01 00 00 00");
}
