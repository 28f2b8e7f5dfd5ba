// SPDX-License-Identifier: Apache-2.0
// Guarding, the high resolution clock, the SYNC counter, the configuration stamp and 1021h to 1029h.
#include "node/eds_text.hpp"
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {

conform::can::Frame guard_request() {
  conform::can::Frame frame = conform::can::data_frame(conform::CanId(0x705), {0x00});
  frame.remote = true;
  return frame;
}

Frames guard(Bench& bench) {
  bench.send(guard_request());
  return bench.take();
}

void store(Bench& bench) { REQUIRE(bench.sdo("23 10 10 01 73 61 76 65") == "60 10 10 01 00 00 00 00"); }

void reset(Bench& bench) {
  bench.send("000: 81 05");
  bench.wait(100ms);
}

/// The first bytes of an upload.
std::string read(Bench& bench, const std::string& object) {
  return bench.sdo("40 " + object + " 00 00 00 00");
}

}  // namespace

TEST_CASE("A communication error does what 1029h:01 says") {
  struct Row {
    const char* reaction;
    const char* state;
  };
  for (const Row& row : {Row{"00", "7F"}, Row{"01", "05"}, Row{"02", "04"}}) {
    INFO(row.reaction);
    Bench bench;
    bench.wait(100ms);
    CHECK(bench.sdo("2F 29 10 01 " + std::string(row.reaction) + " 00 00 00") == "60 29 10 01 00 00 00 00");
    bench.sdo("23 16 10 01 C8 00 7E 00");
    bench.sdo("2B 17 10 00 64 00 00 00");
    bench.send("000: 01 05");
    bench.send("77E: 05");
    bench.wait(250ms);
    CHECK(bench.wait(100ms) == Frames{"705: " + std::string(row.state)});
  }
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("2F 29 10 01 03 00 00 00") == "80 29 10 01 31 00 09 06");
}

TEST_CASE("Emergencies are consumed from the nodes 1028h names") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("23 28 10 01 81 00 00 40") == "80 28 10 01 30 00 09 06");
  CHECK(bench.sdo("23 28 10 01 81 00 00 00") == "60 28 10 01 00 00 00 00");
  CHECK(bench.sdo("23 28 10 01 82 00 00 00") == "80 28 10 01 30 00 09 06");
  CHECK(bench.sdo("23 28 10 04 84 00 00 80") == "80 28 10 04 02 00 01 06");
  bench.send("081: 10 42 09 01 02 03 04 05");
  bench.send("082: 11 11 11 11 11 11 11 11");
  CHECK(read(bench, "11 2F 00") == "41 11 2F 00 08 00 00 00");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "00 10 42 09 01 02 03 04");
}

TEST_CASE("1019h can be changed while 1006h is 0 and decides on the length of a SYNC") {
  Bench bench;
  bench.wait(100ms);
  for (const char* reserved : {"01", "F1", "FF"}) {
    CHECK(bench.sdo("2F 19 10 00 " + std::string(reserved) + " 00 00 00") == "80 19 10 00 30 00 09 06");
  }
  CHECK(bench.sdo("2F 19 10 00 F0 00 00 00") == "60 19 10 00 00 00 00 00");
  CHECK(bench.send("080: 01").empty());
  CHECK(bench.send("080:") == Frames{"085: 40 82 11 00 03 00 00 00"});
  CHECK(bench.send("080: 02") == Frames{"085: 00 00 00 00 03 00 00 00"});
  CHECK(bench.sdo("23 06 10 00 A0 86 01 00") == "60 06 10 00 00 00 00 00");
  CHECK(bench.sdo("2F 19 10 00 00 00 00 00") == "80 19 10 00 22 00 00 08");
  CHECK(bench.sdo("2F 19 10 00 F0 00 00 00") == "60 19 10 00 00 00 00 00");
}

TEST_CASE("The clock of 1013h counts microseconds from the reset or from what was written") {
  Bench bench;
  bench.wait(100ms);
  CHECK(read(bench, "13 10 00") == "43 13 10 00 A0 86 01 00");
  CHECK(bench.sdo("23 13 10 00 FF FF FF FF") == "60 13 10 00 00 00 00 00");
  bench.wait(1ms);
  CHECK(read(bench, "13 10 00") == "43 13 10 00 E7 03 00 00");
}

TEST_CASE("Storing another configuration discards a stamp that was not renewed") {
  Bench bench;
  bench.wait(100ms);
  const auto stamp = [&bench] { return read(bench, "20 10 01") + " | " + read(bench, "20 10 02"); };
  const std::string written = "43 20 10 01 98 3A 00 00 | 43 20 10 02 00 2E 93 02";
  const std::string discarded = "43 20 10 01 00 00 00 00 | 43 20 10 02 00 00 00 00";
  const auto renew = [&bench] {
    bench.sdo("23 20 10 01 98 3A 00 00");
    bench.sdo("23 20 10 02 00 2E 93 02");
  };
  renew();
  bench.sdo("2B 17 10 00 E8 03 00 00");
  store(bench);
  reset(bench);
  CHECK(stamp() == written);
  store(bench);  // nothing is another one
  CHECK(stamp() == written);

  SECTION("of the communication") {
    bench.sdo("2B 17 10 00 D0 07 00 00");
    CHECK(stamp() == written);
    store(bench);
    CHECK(stamp() == discarded);
    reset(bench);
    CHECK(stamp() == discarded);
  }
  SECTION("of the application alone") {
    bench.sdo("2F 06 62 01 00 00 00 00");
    CHECK(bench.sdo("23 10 10 03 73 61 76 65") == "60 10 10 03 00 00 00 00");
    CHECK(stamp() == discarded);
    reset(bench);
    CHECK(stamp() == discarded);
  }
  SECTION("but not one that was renewed") {
    bench.sdo("2B 17 10 00 D0 07 00 00");
    renew();
    store(bench);
    reset(bench);
    CHECK(stamp() == written);
  }
  SECTION("by restoring defaults") {
    CHECK(bench.sdo("23 11 10 01 6C 6F 61 64") == "60 11 10 01 00 00 00 00");
    reset(bench);
    CHECK(stamp() == discarded);
  }
  SECTION("and keeps it when the memory fails") {
    bench.sdo("2B 17 10 00 D0 07 00 00");
    bench.sdo("2F 20 2F 00 01 00 00 00");
    CHECK(bench.sdo("23 10 10 01 73 61 76 65") == "80 10 10 01 00 00 06 06");
    CHECK(stamp() == written);
  }
}

TEST_CASE("The device holds its own description") {
  Bench bench;
  bench.wait(100ms);
  const std::string size = read(bench, "21 10 00");
  std::string expected = "41 21 10 00";
  for (std::size_t i = 0, rest = eds_text().size(); i < 4; ++i, rest >>= 8U)
    expected += " " + conform::hex_bytes(conform::Bytes{static_cast<std::uint8_t>(rest & 0xFFU)});
  CHECK(size == expected);
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "00 5B 46 69 6C 65 49 6E");  // "[FileIn"
  CHECK(read(bench, "22 10 00") == "4B 22 10 00 00 00 00 00");
}

TEST_CASE("A command runs for a while, then its reply can be read") {
  Bench bench;
  bench.wait(100ms);
  CHECK(read(bench, "23 10 02") == "4F 23 10 02 00 00 00 00");
  CHECK(read(bench, "23 10 03") == "80 23 10 03 24 00 00 08");
  CHECK(bench.sdo("21 23 10 01 07 00 00 00") == "60 23 10 01 00 00 00 00");
  CHECK(bench.sdo("01 65 63 68 6F 20 68 69") == "20 00 00 00 00 00 00 00");  // "echo hi"
  CHECK(read(bench, "23 10 02") == "4F 23 10 02 FF 00 00 00");
  CHECK(bench.sdo("23 23 10 01 74 72 75 65") == "80 23 10 01 22 00 00 08");  // busy
  bench.wait(30ms);
  CHECK(read(bench, "23 10 02") == "4F 23 10 02 01 00 00 00");
  CHECK(read(bench, "23 10 03") == "4B 23 10 03 68 69 00 00");
  CHECK(read(bench, "23 10 03") == "4B 23 10 03 68 69 00 00");
  bench.sdo("23 23 10 01 6F 6F 70 73");  // "oops"
  bench.wait(30ms);
  CHECK(read(bench, "23 10 02") == "4F 23 10 02 03 00 00 00");
}

TEST_CASE("Commands can be kept, executed together and abandoned") {
  Bench bench;
  bench.wait(100ms);
  const auto mode = [&bench](const char* value) {
    return bench.sdo("2F 24 10 00 " + std::string(value) + " 00 00 00");
  };
  CHECK(mode("01") == "60 24 10 00 00 00 00 00");
  bench.sdo("23 23 10 01 6F 6F 70 73");
  CHECK(read(bench, "23 10 02") == "4F 23 10 02 00 00 00 00");
  CHECK(mode("02") == "60 24 10 00 00 00 00 00");
  CHECK(read(bench, "23 10 02") == "4F 23 10 02 FF 00 00 00");
  CHECK(mode("03") == "60 24 10 00 00 00 00 00");
  CHECK(read(bench, "23 10 02") == "4F 23 10 02 00 00 00 00");
  CHECK(mode("04") == "80 24 10 00 30 00 09 06");
  CHECK(read(bench, "24 10 00") == "80 24 10 00 01 00 01 06");
}

TEST_CASE("The prompt echoes what it is given") {
  Bench bench;
  bench.wait(100ms);
  CHECK(read(bench, "26 10 02") == "80 26 10 02 24 00 00 08");
  bench.sdo("2F 26 10 01 41 00 00 00");
  bench.sdo("2F 26 10 01 42 00 00 00");
  CHECK(read(bench, "26 10 02") == "4F 26 10 02 41 00 00 00");
  CHECK(read(bench, "26 10 02") == "4F 26 10 02 42 00 00 00");
  CHECK(read(bench, "26 10 02") == "80 26 10 02 24 00 00 08");
  CHECK(read(bench, "26 10 01") == "80 26 10 01 01 00 01 06");
}

TEST_CASE("Guard requests are answered with a toggle bit unless the heartbeat is on") {
  Bench bench;
  bench.wait(100ms);
  CHECK(guard(bench) == Frames{"705: 7F"});
  CHECK(guard(bench) == Frames{"705: FF"});
  bench.send("000: 01 05");
  CHECK(guard(bench) == Frames{"705: 05"});
  bench.sdo("2B 17 10 00 E8 03 00 00");
  CHECK(guard(bench).empty());
  bench.sdo("2B 17 10 00 00 00 00 00");
  CHECK(guard(bench) == Frames{"705: 85"});
  bench.send("000: 82 05");
  CHECK(guard(bench).empty());
  bench.wait(100ms);
  CHECK(guard(bench) == Frames{"705: 7F"});
}

TEST_CASE("Guarding that stays away is a communication error, and ends with the next request") {
  Bench bench;
  bench.wait(100ms);
  bench.sdo("2B 0C 10 00 64 00 00 00");
  bench.sdo("2F 0D 10 00 03 00 00 00");
  bench.send("000: 01 05");
  CHECK(bench.wait(2s).empty());  // not guarded yet
  CHECK(guard(bench) == Frames{"705: 05"});
  CHECK(bench.wait(299ms).empty());
  CHECK(bench.wait(2ms) == Frames{"085: 30 81 11 00 04 00 00 00"});
  CHECK(guard(bench) == Frames{"705: FF", "085: 00 00 00 00 04 00 00 00"});
}
