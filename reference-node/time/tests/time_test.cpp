// SPDX-License-Identifier: Apache-2.0
// Consumer and producer of TIME (CiA 301, 7.2.6, 7.5.2.15).
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {

const std::string produce = "23 12 10 00 00 01 00 40";
const std::string consume = "23 12 10 00 00 01 00 80";
const std::string both = "23 12 10 00 00 01 00 C0";

}  // namespace

TEST_CASE("A producer sends the time of day five times in a second, not in Stopped") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.wait(5s).empty());
  bench.sdo(produce);
  // 08:00:05.300 and a fifth of a second more on day 15000.
  CHECK(bench.wait(400ms, true) == Frames{"@5300 100: B4 88 B7 01 98 3A", "@5500 100: 7C 89 B7 01 98 3A"});
  bench.send("000: 02 05");
  CHECK(bench.wait(5s).empty());
  bench.send("000: 80 05");
  CHECK(bench.wait(200ms).size() == 1);
  bench.sdo("23 12 10 00 00 01 00 00");
  CHECK(bench.wait(5s).empty());
}

TEST_CASE("The time goes on from one that was received, over midnight") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo(consume);
  bench.send("100: FF 5B 26 F5 10 27");  // one millisecond to midnight of day 10001, reserved bits set
  bench.sdo(both);
  CHECK(bench.wait(200ms) == Frames{"100: C7 00 00 00 11 27"});
}

TEST_CASE("The time runs on while none is sent") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo(consume);
  bench.send("100: 00 00 00 00 01 00");
  bench.wait(4s);
  bench.sdo(both);
  CHECK(bench.wait(200ms) == Frames{"100: 68 10 00 00 01 00"});
}
