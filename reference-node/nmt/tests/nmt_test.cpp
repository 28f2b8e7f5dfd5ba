// SPDX-License-Identifier: Apache-2.0
// NMT slave (CiA 301, 7.3.2).
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

TEST_CASE("NMT commands move between the states, which the heartbeat shows") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2B 17 10 00 64 00 00 00");
  CHECK(bench.wait(100ms) == Frames{"705: 7F"});
  bench.send("000: 01 05");
  CHECK(bench.wait(100ms) == Frames{"705: 05"});
  bench.send("000: 02 05");
  CHECK(bench.wait(100ms) == Frames{"705: 04"});
  bench.send("000: 01 00");
  CHECK(bench.wait(100ms) == Frames{"705: 05"});
  bench.send("000: 80 05");
  CHECK(bench.wait(100ms) == Frames{"705: 7F"});
}

TEST_CASE("NMT commands for others, of another length or unknown are ignored") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2B 17 10 00 64 00 00 00");
  bench.send("000: 01 06\n000: 01 85\n000: 01\n000: 01 05 00\n000: 03 05\n000:\n001: 01 05\n");
  CHECK(bench.wait(100ms) == Frames{"705: 7F"});
}

TEST_CASE("Both resets end with one boot-up message, from every state") {
  for (const char* state : {"000: 80 05", "000: 01 05", "000: 02 05"}) {
    for (const char* command : {"000: 81 05", "000: 82 05", "000: 81 00", "000: 82 00"}) {
      Bench bench;
      bench.wait(100ms);
      bench.send(state);
      CHECK(bench.send(command).empty());
      CHECK(bench.wait(2s) == Frames{"705: 00"});
    }
  }
}

TEST_CASE("A reset command during start-up starts it again") {
  Bench bench;
  bench.wait(100ms);
  bench.send("000: 82 05");
  bench.wait(2ms);
  bench.send("000: 82 05");
  CHECK(bench.wait(2s) == Frames{"705: 00"});
}

TEST_CASE("Reset communication restores 1xxxh, reset node everything") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2B 17 10 00 E8 03 00 00");
  bench.sdo("2F 06 62 01 00 00 00 00");
  bench.sdo("23 07 20 00 2A 00 00 00");
  bench.send("000: 82 05");
  CHECK(bench.wait(3s) == Frames{"705: 00"});
  CHECK(bench.sdo("40 17 10 00 00 00 00 00") == "4B 17 10 00 00 00 00 00");
  CHECK(bench.sdo("40 06 62 01 00 00 00 00") == "4F 06 62 01 00 00 00 00");
  CHECK(bench.sdo("40 07 20 00 00 00 00 00") == "43 07 20 00 2A 00 00 00");
  bench.send("000: 81 05");
  bench.wait(100ms);
  CHECK(bench.sdo("40 06 62 01 00 00 00 00") == "4F 06 62 01 FF 00 00 00");
  CHECK(bench.sdo("40 07 20 00 00 00 00 00") == "43 07 20 00 00 00 00 00");
}
