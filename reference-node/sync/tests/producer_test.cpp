// SPDX-License-Identifier: Apache-2.0
// Producer of SYNC (CiA 301, 7.2.5, 7.5.2.5, 7.5.2.6, 7.5.2.22).
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {

const std::string on = "23 05 10 00 80 00 00 40";
const std::string off = "23 05 10 00 80 00 00 00";
const std::string period_100_ms = "23 06 10 00 A0 86 01 00";
const std::string no_period = "23 06 10 00 00 00 00 00";
const std::string count_to_3 = "2F 19 10 00 03 00 00 00";
const std::string done1005 = "60 05 10 00 00 00 00 00";
const std::string done1006 = "60 06 10 00 00 00 00 00";

Bench::Wanted choosing(void (*choose)(SyncProducerChoices&)) {
  return {{.node_id = 5, .adjust = [choose](Parts& parts) { choose(parts.sync_producer.choices); }}};
}

}  // namespace

TEST_CASE("SYNC comes with the period of 1006h while bit 30 of 1005h is set") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo(period_100_ms) == done1006);
  CHECK(bench.wait(1s).empty());
  CHECK(bench.sdo(on) == done1005);
  CHECK(bench.wait(350ms, true) == Frames{"@1200 080: ", "@1300 080: ", "@1400 080: "});
  CHECK(bench.sdo(off) == done1005);
  CHECK(bench.wait(1s).empty());
}

TEST_CASE("The period counts microseconds in 32 bits, and 0 stops the SYNC") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo(on);
  CHECK(bench.wait(1s).empty());
  bench.sdo("23 06 10 00 DC 05 00 00");  // 1.5 ms
  CHECK(bench.wait(15ms).size() == 10);
  bench.sdo("23 06 10 00 00 2D 31 01");  // 20 s
  CHECK(bench.wait(40s, true) == Frames{"@21115 080: ", "@41115 080: "});
  bench.sdo(no_period);
  CHECK(bench.wait(60s).empty());
}

TEST_CASE("A new period counts from the write on, the same one and bit 31 change nothing") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo(period_100_ms);
  bench.sdo(on);
  bench.wait(50ms);
  bench.sdo("23 06 10 00 50 C3 00 00");  // 50 ms
  CHECK(bench.wait(100ms, true) == Frames{"@200 080: ", "@250 080: "});
  bench.wait(25ms);
  bench.sdo("23 06 10 00 50 C3 00 00");
  bench.sdo("23 05 10 00 80 00 00 C0");
  CHECK(bench.wait(50ms, true) == Frames{"@300 080: "});
}

TEST_CASE("With an overflow value SYNC counts from 1, whenever it begins") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo(count_to_3);
  bench.sdo(on);
  bench.sdo(period_100_ms);
  CHECK(bench.wait(500ms) == Frames{"080: 01", "080: 02", "080: 03", "080: 01", "080: 02"});
  SECTION("by bit 30") {
    bench.sdo(off);
    bench.sdo(on);
  }
  SECTION("by the period") {
    bench.sdo(no_period);
    bench.sdo(period_100_ms);
  }
  SECTION("behind Stopped") { bench.send("000: 02 05\n000: 80 05"); }
  CHECK(bench.wait(200ms) == Frames{"080: 01", "080: 02"});
}

TEST_CASE("Another period, and Operational, do not disturb the count") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2F 19 10 00 F0 00 00 00");
  bench.sdo(on);
  bench.sdo(period_100_ms);
  bench.wait(200ms);
  bench.sdo("23 06 10 00 50 C3 00 00");
  CHECK(bench.wait(50ms) == Frames{"080: 03"});
  bench.send("000: 01 05");
  CHECK(bench.wait(50ms).front() == "080: 04");
  CHECK(bench.sdo("2F 19 10 00 00 00 00 00") == "80 19 10 00 22 00 00 08");
}

TEST_CASE("No SYNC is sent in Stopped") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo(period_100_ms);
  bench.sdo(on);
  bench.send("000: 02 05");
  CHECK(bench.wait(1s).empty());
  bench.send("000: 80 05");
  CHECK(bench.wait(100ms) == Frames{"080: "});
}

TEST_CASE("A producer that was stored begins behind the boot-up message") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo(count_to_3);
  bench.sdo(period_100_ms);
  bench.sdo(on);
  bench.wait(100ms);
  bench.send("605: 23 10 10 01 73 61 76 65");
  bench.wait(50ms);
  bench.send("000: 81 05");
  const auto after = bench.wait(1s);
  REQUIRE(after.size() > 3);
  CHECK(after[0] == "705: 00");
  CHECK(after[1] == "080: 01");
  CHECK(after[2] == "080: 02");
}

TEST_CASE("While SYNC is produced its CAN-ID stays") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo(on);
  CHECK(bench.sdo("23 05 10 00 A0 06 00 40") == "80 05 10 00 30 00 09 06");
  bench.sdo(off);
  CHECK(bench.sdo("23 05 10 00 A0 06 00 40") == done1005);
  bench.sdo(period_100_ms);
  CHECK(bench.wait(100ms) == Frames{"6A0: "});
}

TEST_CASE("An own SYNC is one for the synchronous PDOs") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2F 00 18 02 01 00 00 00");
  bench.sdo(on);
  bench.sdo(period_100_ms);
  CHECK(bench.wait(100ms) == Frames{"080: "});
  bench.send("000: 01 05");
  CHECK(bench.wait(100ms) == Frames{"080: ", "185: 00 00 00 00"});
}

TEST_CASE("A producer may have a coarse clock, limits, or begin at once") {
  Bench coarse(choosing([](SyncProducerChoices& c) {
    c.resolution = 1000;
    c.shortest = 2000;
    c.longest = 1000000;
  }));
  coarse.wait(100ms);
  CHECK(coarse.sdo("23 06 10 00 C5 09 00 00") == "80 06 10 00 30 00 09 06");  // 2501
  CHECK(coarse.sdo("23 06 10 00 E8 03 00 00") == "80 06 10 00 32 00 09 06");  // 1000
  CHECK(coarse.sdo("23 06 10 00 80 84 1E 00") == "80 06 10 00 31 00 09 06");  // 2 s
  CHECK(coarse.sdo(no_period) == done1006);
  CHECK(coarse.sdo(period_100_ms) == done1006);

  Bench hasty(choosing([](SyncProducerChoices& c) { c.first_at_once = true; }));
  hasty.wait(100ms);
  hasty.sdo(period_100_ms);
  hasty.sdo(on);
  CHECK(hasty.wait(100ms, true) == Frames{"@100 080: ", "@200 080: "});
}
