// SPDX-License-Identifier: Apache-2.0
// What a SYNC does: counter, synchronous window, and what may be made of one that stays away (CiA 301,
// 7.5.2.6, 7.5.2.7, 7.5.2.22).
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {

const std::string outputs_1 = "40 00 62 01 00 00 00 00";
const std::string period_100_ms = "23 06 10 00 A0 86 01 00";

/// A node in Operational whose RPDO and TPDO are synchronous.
void synchronise(Bench& bench) {
  bench.wait(100ms);
  bench.sdo("2F 00 14 02 01 00 00 00");
  bench.sdo("2F 00 18 02 01 00 00 00");
}

Bench::Wanted supervising() {
  return {
      {.node_id = 5, .adjust = [](Parts& parts) { parts.sync_supervision.choices.loss_reported = true; }}};
}

}  // namespace

TEST_CASE("With an overflow value a SYNC has one byte, whatever it counts") {
  Bench bench;
  synchronise(bench);
  bench.sdo("2F 19 10 00 0A 00 00 00");
  bench.send("000: 01 05");
  for (const auto* sync : {"080: 01", "080: 0A", "080: 0A", "080: 00", "080: FF"})
    CHECK(bench.send(sync) == Frames{"185: 00 00 00 00"});
  CHECK(bench.send("080:") == Frames{"085: 40 82 11 00 03 00 00 00", "185: 00 00 00 00"});
  CHECK(bench.send("080: 01").front() == "085: 00 00 00 00 03 00 00 00");
}

TEST_CASE("Synchronous RPDOs behind the window are discarded until the next SYNC") {
  Bench bench;
  synchronise(bench);
  bench.sdo("23 07 10 00 20 4E 00 00");  // 20 ms
  bench.send("000: 01 05\n080:");
  bench.wait(21ms);
  bench.send("205: 11 00 00 00\n080:");
  CHECK(bench.sdo(outputs_1) == "4F 00 62 01 00 00 00 00");
  bench.wait(19ms);
  bench.send("205: 22 00 00 00\n080:");
  CHECK(bench.sdo(outputs_1) == "4F 00 62 01 22 00 00 00");
}

TEST_CASE("Window length 0 is no window") {
  Bench bench;
  synchronise(bench);
  bench.send("000: 01 05\n080:");
  bench.wait(5s);
  bench.send("205: 11 00 00 00\n080:");
  CHECK(bench.sdo(outputs_1) == "4F 00 62 01 11 00 00 00");
}

TEST_CASE("A SYNC that stays away is nobody's error by default") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo(period_100_ms);
  bench.send("080:");
  CHECK(bench.wait(10s).empty());
}

TEST_CASE("Whoever supervises SYNC reports a lost one once, from the first one on") {
  Bench bench(supervising());
  bench.wait(100ms);
  bench.sdo(period_100_ms);
  CHECK(bench.wait(1s).empty());
  bench.send("080:");
  CHECK(bench.wait(1s, true) == Frames{"@1250 085: 00 81 11 00 03 00 00 00"});
  CHECK(bench.send("080:") == Frames{"085: 00 00 00 00 03 00 00 00"});
  bench.send("000: 02 05");
  CHECK(bench.wait(1s).empty());
}
