// SPDX-License-Identifier: Apache-2.0
// Additional SDO servers 1201h and 1202h, the client parameter 1280h, and large objects (CiA 301, 7.5.2.33).
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

namespace {

constexpr auto done_1201_1 = "60 01 12 01 00 00 00 00";
constexpr auto done_1201_2 = "60 01 12 02 00 00 00 00";

void open_channel(Bench& bench) {
  CHECK(bench.sdo("23 01 12 01 C0 06 00 00") == done_1201_1);
  CHECK(bench.sdo("23 01 12 02 C1 06 00 00") == done_1201_2);
}

}  // namespace

TEST_CASE("An additional server answers once both COB-IDs are valid") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 01 12 00 00 00 00 00") == "4F 01 12 00 03 00 00 00");
  CHECK(bench.sdo("40 01 12 01 00 00 00 00") == "43 01 12 01 00 00 00 80");
  CHECK(bench.sdo("2F 01 12 00 02 00 00 00") == "80 01 12 00 02 00 01 06");
  CHECK(bench.sdo("23 01 12 01 C0 06 00 00") == done_1201_1);
  CHECK(bench.send("6C0: 40 00 10 00 00 00 00 00").empty());
  CHECK(bench.sdo("23 01 12 01 C0 06 00 80") == done_1201_1);
  CHECK(bench.sdo("23 01 12 02 C1 06 00 00") == done_1201_2);
  CHECK(bench.send("6C0: 40 00 10 00 00 00 00 00").empty());
  CHECK(bench.sdo("23 01 12 01 C0 06 00 00") == done_1201_1);
  CHECK(bench.send("6C0: 40 00 10 00 00 00 00 00") == Frames{"6C1: 43 00 10 00 91 01 0F 00"});
  CHECK(bench.sdo("40 00 10 00 00 00 00 00") == "43 00 10 00 91 01 0F 00");
  // Silent in Stopped, gone after reset communication.
  bench.send("000: 02 05");
  CHECK(bench.send("6C0: 40 00 10 00 00 00 00 00").empty());
  bench.send("000: 82 05");
  bench.wait(100ms);
  CHECK(bench.send("6C0: 40 00 10 00 00 00 00 00").empty());
  CHECK(bench.sdo("40 01 12 01 00 00 00 00") == "43 01 12 01 00 00 00 80");
}

TEST_CASE("A channel can take itself out of use and still confirms that") {
  Bench bench;
  bench.wait(100ms);
  open_channel(bench);
  CHECK(bench.send("6C0: 23 01 12 01 C0 06 00 80") == Frames{"6C1: 60 01 12 01 00 00 00 00"});
  CHECK(bench.send("6C0: 40 00 10 00 00 00 00 00").empty());
}

TEST_CASE("The COB-IDs of a channel keep their rules") {
  Bench bench;
  bench.wait(100ms);
  open_channel(bench);
  // Locked while valid; bit 29 and restricted CAN-IDs are refused; bit 30 is allowed.
  CHECK(bench.sdo("23 01 12 01 C2 06 00 00") == "80 01 12 01 30 00 09 06");
  CHECK(bench.sdo("23 01 12 01 C0 06 00 80") == done_1201_1);
  CHECK(bench.sdo("23 01 12 01 C2 06 00 A0") == "80 01 12 01 30 00 09 06");
  CHECK(bench.sdo("23 01 12 01 01 06 00 00") == "80 01 12 01 30 00 09 06");
  CHECK(bench.sdo("23 01 12 01 C2 06 00 40") == done_1201_1);
  CHECK(bench.sdo("2F 01 12 03 7F 00 00 00") == "60 01 12 03 00 00 00 00");
  CHECK(bench.sdo("2F 01 12 03 80 00 00 00") == "80 01 12 03 31 00 09 06");
  CHECK(bench.sdo("2F 01 12 03 00 00 00 00") == "80 01 12 03 32 00 09 06");
}

TEST_CASE("Two servers run their transfers beside each other") {
  Bench bench;
  bench.wait(100ms);
  open_channel(bench);
  CHECK(bench.sdo("40 08 10 00 00 00 00 00") == "41 08 10 00 0F 00 00 00");
  CHECK(bench.send("6C0: 40 06 20 00 00 00 00 00") == Frames{"6C1: 41 06 20 00 0E 00 00 00"});
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "00 63 61 6E 6F 70 65 6E");
  CHECK(bench.send("6C0: 60 00 00 00 00 00 00 00") == Frames{"6C1: 00 72 65 66 65 72 65 6E"});
  CHECK(bench.send("6C0: 80 06 20 00 00 00 00 08").empty());
  CHECK(bench.sdo("70 00 00 00 00 00 00 00") == "10 2D 72 65 66 6E 6F 64");
  // A sub-block does not keep the other server from answering.
  bench.sdo("A0 08 20 00 7F 00 00 00");
  bench.send("605: A3 00 00 00 00 00 00 00");
  CHECK(bench.send("6C0: 40 00 10 00 00 00 00 00") == Frames{"6C1: 43 00 10 00 91 01 0F 00"});
  CHECK(bench.wait(1ms).back().starts_with("585: 7F"));
}

TEST_CASE("A dynamic channel is not stored, a static one is") {
  const auto storage = std::make_shared<MemoryStorage>();
  Bench bench({}, storage);
  bench.wait(100ms);
  const auto save_and_reset = [&] {
    CHECK(bench.sdo("23 10 10 01 73 61 76 65") == "60 10 10 01 00 00 00 00");
    bench.send("000: 81 05");
    bench.wait(100ms);
  };
  bench.sdo("23 01 12 01 C0 06 00 C0");
  bench.sdo("23 01 12 02 C1 06 00 80");
  save_and_reset();
  CHECK(bench.sdo("40 01 12 01 00 00 00 00") == "43 01 12 01 00 00 00 80");
  CHECK(bench.sdo("40 01 12 02 00 00 00 00") == "43 01 12 02 00 00 00 80");
  bench.sdo("23 80 12 01 C0 06 00 00");
  open_channel(bench);
  save_and_reset();
  CHECK(bench.send("6C0: 40 00 10 00 00 00 00 00") == Frames{"6C1: 43 00 10 00 91 01 0F 00"});
  CHECK(bench.sdo("40 80 12 01 00 00 00 00") == "43 80 12 01 C0 06 00 00");
  // What was stored before stays.
  bench.sdo("23 01 12 01 C0 06 00 C0");
  save_and_reset();
  CHECK(bench.sdo("40 01 12 01 00 00 00 00") == "43 01 12 01 C0 06 00 00");
}

TEST_CASE("A large object goes up and down whole and is not stored") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("C2 08 20 00 01 00 40 00") == "80 08 20 00 12 00 07 06");  // one byte too many
  CHECK(bench.sdo("C2 08 20 00 00 00 40 00") == "A4 08 20 00 7F 00 00 00");  // 4 MiB
  constexpr std::size_t segments = (std::size_t{4} * 1024 * 1024 + 6) / 7;
  std::size_t wrong = 0;
  for (std::size_t sent = 0; sent < segments;) {
    for (unsigned number = 1; number <= 127 && sent < segments; ++number) {
      const bool last = ++sent == segments;
      conform::can::Frame frame = conform::can::data_frame(
          conform::CanId(0x605),
          {static_cast<std::uint8_t>(number | (last ? 0x80U : 0U)), 1, 2, 3, 4, 5, 6, 7});
      bench.send(frame);
      const bool due = last || number == 127;
      if (bench.take().size() != (due ? 1U : 0U)) ++wrong;
    }
  }
  CHECK(wrong == 0);
  CHECK(bench.sdo("D5 00 00 00 00 00 00 00") == "A1 00 00 00 00 00 00 00");  // 2 of 7 bytes
  CHECK(bench.sdo("40 08 20 00 00 00 00 00") == "41 08 20 00 00 00 40 00");
  bench.send("000: 81 05");
  bench.wait(100ms);
  CHECK(bench.sdo("40 08 20 00 00 00 00 00") == "41 08 20 00 E8 03 00 00");
}
