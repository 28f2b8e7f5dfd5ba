// SPDX-License-Identifier: Apache-2.0
// LSS slave (CiA 305), spoken to by frames. The reference node is vendor 5AFEh, product 301h, revision 1.0,
// serial number 1.
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {

constexpr const char* waiting = "7E5: 04 00 00 00 00 00 00 00";
constexpr const char* configuration = "7E5: 04 01 00 00 00 00 00 00";
constexpr const char* which_node_id = "7E5: 5E 00 00 00 00 00 00 00";

/// Node 5 after its boot-up message, in LSS configuration state.
struct Configured : Bench {
  using Bench::Bench;
  void prepare() {
    wait(100ms);
    send(configuration);
  }
};

Frames select(Bench& bench, const char* serial = "01 00 00 00") {
  std::string last = std::string("7E5: 43 ") + serial + " 00 00 00";
  Frames all =
      bench.send("7E5: 40 FE 5A 00 00 00 00 00\n7E5: 41 01 03 00 00 00 00 00\n7E5: 42 00 00 01 00 00 00 00");
  CHECK(all.empty());
  return bench.send(last);
}

}  // namespace

TEST_CASE("LSS: only in the configuration state the node-ID is told") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.send(which_node_id).empty());
  CHECK(bench.send(configuration).empty());
  CHECK(bench.send(which_node_id) == Frames{"7E4: 5E 05 00 00 00 00 00 00"});
  CHECK(bench.send(waiting).empty());
  CHECK(bench.send(which_node_id).empty());
}

TEST_CASE("LSS: an unknown mode of switch state global changes nothing") {
  Bench bench;
  bench.wait(100ms);
  bench.send("7E5: 04 02 00 00 00 00 00 00");
  CHECK(bench.send(which_node_id).empty());
  bench.send(configuration);
  bench.send("7E5: 04 FF 00 00 00 00 00 00");
  CHECK(bench.send(which_node_id).size() == 1);
}

TEST_CASE("LSS: the slave whose address is named answers and is in the configuration state") {
  Bench bench;
  bench.wait(100ms);
  CHECK(select(bench) == Frames{"7E4: 44 00 00 00 00 00 00 00"});
  CHECK(bench.send(which_node_id).size() == 1);
}

TEST_CASE("LSS: another address, a part left out or parts in another order select nobody") {
  Bench bench;
  bench.wait(100ms);
  CHECK(select(bench, "02 00 00 00").empty());
  CHECK(bench.send("7E5: 43 01 00 00 00 00 00 00").empty());
  CHECK(bench.send("7E5: 40 FE 5A 00 00 00 00 00\n7E5: 41 01 03 00 00 00 00 00\n7E5: 43 01 00 00 00 00 00 00")
            .empty());
  CHECK(bench
            .send("7E5: 41 01 03 00 00 00 00 00\n7E5: 40 FE 5A 00 00 00 00 00\n7E5: 42 00 00 01 00 00 00 00\n"
                  "7E5: 43 01 00 00 00 00 00 00")
            .empty());
  CHECK(bench.send(which_node_id).empty());
  CHECK(select(bench).size() == 1);
}

TEST_CASE("LSS: the LSS address is that of 1018h, least significant byte first") {
  Configured bench;
  bench.prepare();
  CHECK(bench.send("7E5: 5A 00 00 00 00 00 00 00") == Frames{"7E4: 5A FE 5A 00 00 00 00 00"});
  CHECK(bench.send("7E5: 5B 00 00 00 00 00 00 00") == Frames{"7E4: 5B 01 03 00 00 00 00 00"});
  CHECK(bench.send("7E5: 5C 00 00 00 00 00 00 00") == Frames{"7E4: 5C 00 00 01 00 00 00 00"});
  CHECK(bench.send("7E5: 5D 00 00 00 00 00 00 00") == Frames{"7E4: 5D 01 00 00 00 00 00 00"});
}

TEST_CASE("LSS: node-IDs are 1 to 127, or FFh for none") {
  Configured bench;
  bench.prepare();
  for (const char* good : {"01", "7F", "05", "FF"})
    CHECK(bench.send(std::string("7E5: 11 ") + good + " 00 00 00 00 00 00") ==
          Frames{"7E4: 11 00 00 00 00 00 00 00"});
  for (const char* bad : {"00", "80", "FE"})
    CHECK(bench.send(std::string("7E5: 11 ") + bad + " 00 00 00 00 00 00") ==
          Frames{"7E4: 11 01 00 00 00 00 00 00"});
}

TEST_CASE("LSS: a node-ID is active from the next reset communication on, and the default COB-IDs with it") {
  Configured bench;
  bench.prepare();
  bench.send("7E5: 11 09 00 00 00 00 00 00");
  bench.send(waiting);
  CHECK(bench.sdo("40 14 10 00 00 00 00 00") == "43 14 10 00 85 00 00 00");
  bench.send("000: 82 05");
  CHECK(bench.wait(100ms) == Frames{"709: 00"});
  CHECK(bench.send("605: 40 14 10 00 00 00 00 00").empty());
  CHECK(bench.send("609: 40 14 10 00 00 00 00 00") == Frames{"589: 43 14 10 00 89 00 00 00"});
  CHECK(bench.send("609: 40 00 12 01 00 00 00 00") == Frames{"589: 43 00 12 01 09 06 00 00"});
  CHECK(bench.send("609: 40 00 18 01 00 00 00 00") == Frames{"589: 43 00 18 01 89 01 00 40"});
  // What was not stored is gone with reset node.
  bench.send("000: 81 09");
  CHECK(bench.wait(100ms) == Frames{"705: 00"});
}

TEST_CASE("LSS: what is stored is there after reset node and power-on, and 1011h leaves it alone") {
  auto storage = std::make_shared<MemoryStorage>();
  {
    Configured bench({}, storage);
    bench.prepare();
    bench.send("7E5: 11 09 00 00 00 00 00 00");
    CHECK(bench.send("7E5: 17 00 00 00 00 00 00 00") == Frames{"7E4: 17 00 00 00 00 00 00 00"});
    bench.send("000: 81 05");
    CHECK(bench.wait(100ms) == Frames{"709: 00"});
    bench.send("609: 23 11 10 01 6C 6F 61 64");
  }
  Bench again({}, storage);
  CHECK(again.wait(100ms) == Frames{"709: 00"});
}

TEST_CASE("LSS: a memory that fails is error code 2") {
  Configured bench;
  bench.prepare();
  bench.sdo("2F 20 2F 00 01 00 00 00");
  CHECK(bench.send("7E5: 17 00 00 00 00 00 00 00") == Frames{"7E4: 17 02 00 00 00 00 00 00"});
}

TEST_CASE("LSS: the bit rates of table 0 are accepted, the reserved one and others are not") {
  Configured bench;
  bench.prepare();
  for (const char* good : {"00", "04", "06", "08"})
    CHECK(bench.send(std::string("7E5: 13 00 ") + good + " 00 00 00 00 00") ==
          Frames{"7E4: 13 00 00 00 00 00 00 00"});
  for (const char* bad : {"00 05", "00 0A", "00 FF", "01 00", "7F 00"})
    CHECK(bench.send(std::string("7E5: 13 ") + bad + " 00 00 00 00 00") ==
          Frames{"7E4: 13 01 00 00 00 00 00 00"});
  CHECK(bench.send("7E5: 15 0A 00 00 00 00 00 00").empty());
}

TEST_CASE("LSS: a slave within the ranges identifies itself after the last of them, both ends included") {
  const auto identify = [](Bench& bench, const char* low, const char* high) {
    return bench.send(std::string("7E5: 46 FE 5A 00 00 00 00 00\n7E5: 47 01 03 00 00 00 00 00\n"
                                  "7E5: 48 00 00 01 00 00 00 00\n7E5: 49 00 00 01 00 00 00 00\n7E5: 4A ") +
                      low + " 00 00 00 00 00 00\n7E5: 4B " + high + " 00 00 00 00 00 00");
  };
  Bench bench;
  bench.wait(100ms);
  CHECK(identify(bench, "01", "01") == Frames{"7E4: 4F 00 00 00 00 00 00 00"});
  CHECK(identify(bench, "00", "02").size() == 1);
  CHECK(identify(bench, "02", "03").empty());
  CHECK(identify(bench, "00", "00").empty());
  CHECK(bench.send(which_node_id).empty());
  CHECK(bench.send("7E5: 4B 01 00 00 00 00 00 00").empty());
}

TEST_CASE(
    "LSS: a node without node-ID does not boot up, is found by fastscan, and boots up with the one it gets") {
  Bench bench({}, {}, 255);
  CHECK(bench.wait(5s).empty());
  CHECK(bench.send("7E5: 4C 00 00 00 00 00 00 00") == Frames{"7E4: 50 00 00 00 00 00 00 00"});
  const Frames yes{"7E4: 4F 00 00 00 00 00 00 00"};
  CHECK(bench.send("7E5: 51 00 00 00 00 80 00 00") == yes);
  // Bit 14 of 5AFEh is set, bit 15 is not; the next part is not the one expected.
  CHECK(bench.send("7E5: 51 00 00 00 00 0F 00 00") == yes);
  CHECK(bench.send("7E5: 51 00 00 00 00 0E 00 00").empty());
  CHECK(bench.send("7E5: 51 00 40 00 00 0E 00 00") == yes);
  CHECK(bench.send("7E5: 51 01 03 00 00 00 01 01").empty());
  CHECK(bench.send("7E5: 51 FE 5A 00 00 20 00 00").empty());
  CHECK(bench.send("7E5: 51 FE 5A 00 00 00 00 01") == yes);
  CHECK(bench.send("7E5: 51 01 03 00 00 00 01 02") == yes);
  CHECK(bench.send("7E5: 51 00 00 01 00 00 02 03") == yes);
  CHECK(bench.send(which_node_id).empty());
  CHECK(bench.send("7E5: 51 01 00 00 00 00 03 00") == yes);
  CHECK(bench.send(which_node_id) == Frames{"7E4: 5E FF 00 00 00 00 00 00"});
  bench.send("7E5: 11 07 00 00 00 00 00 00");
  CHECK(bench.wait(1s).empty());
  bench.send(waiting);
  CHECK(bench.wait(100ms) == Frames{"707: 00"});
  CHECK(bench.send("607: 40 14 10 00 00 00 00 00") == Frames{"587: 43 14 10 00 87 00 00 00"});
  // With a node-ID it takes no part any more.
  CHECK(bench.send("7E5: 4C 00 00 00 00 00 00 00\n7E5: 51 00 00 00 00 80 00 00").empty());
}

TEST_CASE("LSS: frames of another length, remote and extended ones are no commands") {
  Bench bench;
  bench.wait(100ms);
  bench.send("7E5: 04 01");
  bench.send_extended(configuration);
  conform::can::Frame remote = conform::can::data_frame(conform::CanId(0x7E5), {4, 1, 0, 0, 0, 0, 0, 0});
  remote.remote = true;
  bench.send(remote);
  CHECK(bench.send(which_node_id).empty());
}

TEST_CASE("LSS: a reset ends the configuration state, start and stop do not") {
  Configured bench;
  bench.prepare();
  bench.send("000: 01 05\n000: 02 05");
  CHECK(bench.send(which_node_id).size() == 1);
  bench.send("000: 82 05");
  bench.wait(100ms);
  CHECK(bench.send(which_node_id).empty());
}
