// SPDX-License-Identifier: Apache-2.0
// The rules for writing COB-ID parameters, and that the new CAN-ID is used (CiA 301, 7.3.5 and 7.5.2).
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

TEST_CASE("Who produces neither SYNC nor TIME refuses bit 30") {
  Bench bench(Bench::Wanted{{.node_id = 5, .adjust = [](Parts& parts) {
                               parts.sync.cob_id_rules.choices.produced = false;
                               parts.time.cob_id_rules.choices.produced = false;
                             }}});
  bench.wait(100ms);
  CHECK(bench.sdo("23 05 10 00 80 00 00 40") == "80 05 10 00 30 00 09 06");
  CHECK(bench.sdo("23 12 10 00 00 01 00 40") == "80 12 10 00 30 00 09 06");
}

TEST_CASE("1005h takes another CAN-ID, but no 29 bits") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 05 10 00 00 00 00 00") == "43 05 10 00 80 00 00 00");
  CHECK(bench.sdo("23 05 10 00 80 00 00 20") == "80 05 10 00 30 00 09 06");
  CHECK(bench.sdo("23 05 10 00 80 08 00 00") == "80 05 10 00 30 00 09 06");
  CHECK(bench.sdo("23 05 10 00 00 00 00 00") == "80 05 10 00 30 00 09 06");
  CHECK(bench.sdo("23 05 10 00 80 00 00 80") == "60 05 10 00 00 00 00 00");
  CHECK(bench.sdo("23 05 10 00 A0 06 00 00") == "60 05 10 00 00 00 00 00");
  CHECK(bench.sdo("40 05 10 00 00 00 00 00") == "43 05 10 00 A0 06 00 00");
  CHECK(bench.send("080: 01").empty());
  CHECK(bench.send("6A0: 01") == Frames{"085: 40 82 11 01 03 00 00 00"});
}

TEST_CASE("1012h is locked while TIME is consumed") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 12 10 00 00 00 00 00") == "43 12 10 00 00 01 00 00");
  CHECK(bench.sdo("23 12 10 00 00 01 00 20") == "80 12 10 00 30 00 09 06");
  CHECK(bench.sdo("23 12 10 00 00 01 00 80") == "60 12 10 00 00 00 00 00");
  CHECK(bench.sdo("23 12 10 00 A0 06 00 80") == "80 12 10 00 30 00 09 06");
  CHECK(bench.sdo("23 12 10 00 00 01 00 80") == "60 12 10 00 00 00 00 00");
  CHECK(bench.send("100: 00 36 6E F1 10 27").empty());
  CHECK(bench.sdo("40 10 2F 00 00 00 00 00") == "41 10 2F 00 06 00 00 00");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "03 00 36 6E 01 10 27 00");
  CHECK(bench.sdo("23 12 10 00 00 01 00 00") == "60 12 10 00 00 00 00 00");
  CHECK(bench.sdo("23 12 10 00 A0 06 00 00") == "60 12 10 00 00 00 00 00");
  bench.send("6A0: FF FF FF 0F FF FF");
  CHECK(bench.sdo("40 10 2F 00 00 00 00 00") == "41 10 2F 00 06 00 00 00");
  CHECK(bench.sdo("60 00 00 00 00 00 00 00") == "03 00 36 6E 01 10 27 00");
}

TEST_CASE("1014h is moved by way of not valid") {
  Bench bench;
  bench.wait(100ms);
  CHECK(bench.sdo("40 14 10 00 00 00 00 00") == "43 14 10 00 85 00 00 00");
  CHECK(bench.sdo("23 14 10 00 85 00 00 00") == "60 14 10 00 00 00 00 00");
  CHECK(bench.sdo("23 14 10 00 A0 06 00 00") == "80 14 10 00 30 00 09 06");
  CHECK(bench.sdo("23 14 10 00 85 00 00 80") == "60 14 10 00 00 00 00 00");
  CHECK(bench.sdo("2B 00 2F 01 10 42 00 00") == "60 00 2F 01 00 00 00 00");  // not valid: no EMCY
  CHECK(bench.sdo("23 14 10 00 85 00 00 A0") == "80 14 10 00 30 00 09 06");
  CHECK(bench.sdo("23 14 10 00 85 00 00 C0") == "80 14 10 00 30 00 09 06");
  CHECK(bench.sdo("23 14 10 00 05 07 00 00") == "80 14 10 00 30 00 09 06");
  CHECK(bench.sdo("23 14 10 00 A0 06 00 80") == "60 14 10 00 00 00 00 00");
  CHECK(bench.sdo("23 14 10 00 A0 06 00 00") == "60 14 10 00 00 00 00 00");
  CHECK(bench.send("605: 2B 00 2F 01 10 23 00 00") ==
        Frames{"6A0: 10 23 0B 00 00 00 00 00", "585: 60 00 2F 01 00 00 00 00"});
  bench.send("000: 82 05");
  bench.wait(100ms);
  CHECK(bench.sdo("40 14 10 00 00 00 00 00") == "43 14 10 00 85 00 00 00");
}

TEST_CASE("Restricted CAN-IDs cannot become active, their neighbours can") {
  Bench bench;
  bench.wait(100ms);
  const auto set = [&](unsigned id) {
    bench.sdo("23 14 10 00 85 00 00 80");
    const conform::Bytes bytes = conform::to_le(id, 4);
    return bench.sdo("23 14 10 00 " + conform::hex_bytes(bytes)).starts_with("60");
  };
  for (const unsigned id : {0x000U, 0x001U, 0x07FU, 0x101U, 0x180U, 0x581U, 0x5FFU, 0x601U, 0x67FU, 0x6E0U,
                            0x6FFU, 0x701U, 0x77FU, 0x780U, 0x7FFU}) {
    INFO(id);
    CHECK_FALSE(set(id));
  }
  for (const unsigned id : {0x080U, 0x100U, 0x181U, 0x580U, 0x600U, 0x680U, 0x6DFU, 0x700U}) {
    INFO(id);
    CHECK(set(id));
  }
  CHECK(bench.sdo("23 14 10 00 00 00 00 80").starts_with("60"));  // not valid: nothing is used
}
