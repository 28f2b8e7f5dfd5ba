// SPDX-License-Identifier: Apache-2.0
// A right device is never failed: each legal variant alone, and some combinations. The program legal_variants
// runs as many more as there is time for.
#include <set>

#include "catch.hpp"
#include "cli/proof/legal_variants.hpp"
#include "shipped.hpp"
#include "variants/variant.hpp"

using namespace conform;
namespace shipped = cli::shipped;

namespace {

void check(const cli::Combination& combination) {
  const auto complaints = cli::judge_combination(combination, shipped::suites(), shipped::reference());
  INFO("legal_variants " << combination.text());
  REQUIRE(complaints.has_value());
  for (const auto& complaint : *complaints) FAIL_CHECK(complaint.what << "\n" << complaint.details);
}

}  // namespace

TEST_CASE("a node as it is by default passes, described or not, alone or among others") {
  for (const bool described : {true, false}) {
    for (const bool neighbours : {true, false}) {
      cli::Combination combination;
      combination.described = described;
      combination.neighbours = neighbours;
      check(combination);
    }
  }
}

TEST_CASE("each legal variant alone is never failed") {
  bool described = true;
  for (const auto& variant : refnode::variants()) {
    cli::Combination combination;
    combination.variants = {std::string(variant.id)};
    combination.node = 5;
    combination.described = described = !described;
    check(combination);
  }
}

TEST_CASE("combinations of legal variants are never failed") {
  for (std::uint64_t number = 0; number < 5; ++number) check(cli::draw_combination(1, number));
}

TEST_CASE("a device that stores by itself what its restricted CAN-IDs forbid to undo is not failed") {
  // OD-DSC-03 was failed: the node refused its own default as the restricted CAN-ID 000h, and kept what a
  // test had written.
  //   601 [8] 23 28 10 01 81 00 00 80   581 [8] 60 28 10 01 00 00 00 00   1028h:01 = 8000 0081h, stored at
  //   once 601 [8] 23 28 10 01 00 00 00 80   581 [8] 80 28 10 01 30 00 09 06   0609 0030h 000 [2] 81 01 701
  //   [1] 00 601 [8] 40 28 10 01 00 00 00 00   581 [8] 43 28 10 01 81 00 00 80   declared default: 8000 0000h
  cli::Combination combination;
  combination.variants = {"1010-autonomous-at-once", "restricted-always"};
  check(combination);
}

TEST_CASE("a device that stores communication parameters by itself is not blamed for a refused signature") {
  // 1010h:01 reads 1 (on command), 1010h:02 reads 2 (by itself), and answers take their time:
  // 605: 23 10 10 01 6C 6F 61 64 -> 585: 80 10 10 01 20 00 00 08, and more than 4 s after 1017h was written
  // the device stores it; 705: 00 behind reset node, 605: 40 17 10 00 .. -> 585: 4B 17 10 00 20 4E 00 00.
  cli::Combination combination;
  combination.variants = {"1010-autonomous-02-only", "sdo-turnaround-1200ms", "sdo-short-in-segments"};
  check(combination);
}

TEST_CASE("a device that stores by itself is put right behind a reset of all nodes too") {
  // CAN-LOAD-02 was inconclusive: 1016h:01 = 007E 01F4h was stored while a case waited, put back, and came
  // back with 000 [2] 81 00, which nobody counted as a reset of this device. Behind the burst of 77E [1] 05
  // came 081 [8] 30 81 11 7E .., and with 1029h:01 = 2 the device was in Stopped.
  cli::Combination combination;
  combination.variants = {"1010-autonomous", "1029-stops"};
  check(combination);
}

TEST_CASE("a TPDO that maps nothing and is not sent is not failed for its 29 bits") {
  // CAN-EXT-01 was failed: another TPDO stood for the one whose COB-ID was changed.
  //   601 [8] 23 00 18 01 C1 01 A5 38   581 [8] 60 00 18 01 .., 1A00h:00 = 0   000 [2] 01 01
  //   281 [8] FF .., and nothing on 18A501C1.
  cli::Combination combination;
  combination.variants = {"1017-const", "1A00-empty", "tpdo-29-bit"};
  check(combination);
}

TEST_CASE("a device that starts with a new node-ID at once hears no command to the old one") {
  // PDO-TX-02 was failed: the TPDOs of a self-starting device came behind a command that it could not hear.
  //   7E5 [8] 11 7D ..   7E4 [8] 11 00 ..   7E5 [8] 04 00 ..   000 [2] 80 01   77D [1] 00   181 [4] 00 00 00
  //   00
  cli::Combination combination;
  combination.variants = {"1010-only", "boot-up-200ms", "self-starting", "lss-node-id-at-once",
                          "tpdo-initial"};
  check(combination);
}

TEST_CASE("a device whose power can be switched has its boot_time from when the power is back") {
  // NMT-BOOT-01 and STO-1010-06 were failed: the power switch had returned 600 ms before the power was back,
  // and 705 [1] 00 came 5.5 s behind it, 4.9 s behind the power; boot_time is 5 s.
  cli::Combination combination;
  combination.switched = true;
  check(combination);
  combination.variants = {"boot-up-4900ms"};
  check(combination);
}

TEST_CASE("a device that stores by itself and brings back a COB-ID EMCY that is not valid is not failed") {
  // EMCY-INH-02 was failed: what another case had made of 1014h was stored while it lasted.
  //   601 [8] 23 14 10 00 81 00 00 00   581 [8] 60 14 10 00 ..   601 [8] 2B 15 10 00 E8 FD 00 00
  //   77E [1] 05   081 [8] 30 81 11 7E 01 ..   000 [2] 82 01   701 [1] 00   77E [1] 05, no EMCY, and
  //   601 [8] 40 14 10 00 ..   581 [8] 43 14 10 00 81 00 00 80
  cli::Combination combination;
  combination.described = false;
  combination.variants = {"1010-autonomous-02-only", "sdo-turnaround-400ms"};
  check(combination);
}

TEST_CASE("a heartbeat that crosses the command of a reset is not taken for a boot-up message") {
  // NMT-BOOT-04 was failed, and what rests on it was not judged: 1017h is const, 250 kbit/s.
  //   000 [2] 81 37, 737 [1] 7F 232 us behind it, 737 [1] 00 after 200 ms
  cli::Combination combination;
  combination.variants = {"1017-const", "heartbeat-crosses-reset"};
  check(combination);
}

TEST_CASE("a clock of its own is not judged by the time that it shows by chance") {
  // TIME-PRO-01 was failed: it was 12:35 by the node's own clock just when a TIME of 12:34:56.789 had been
  // sent.
  //   100 [6] 95 2C B3 02 10 27   100 [6] .. .. B3 02 98 3A
  cli::Combination combination;
  combination.variants = {"time-always-from-12-35"};
  check(combination);
}

TEST_CASE("rows of the variants are sound") {
  std::set<std::string_view> ids, groups;
  for (const auto& variant : refnode::variants()) {
    INFO(variant.id);
    CHECK(ids.insert(variant.id).second);
    groups.insert(variant.group);
    CHECK_FALSE(variant.summary.empty());
    CHECK_FALSE(variant.legal.empty());
    for (const auto word : variant.lacks) CHECK(device::is_feature(word));
    for (const auto word : variant.gains) CHECK(device::is_feature(word));
    for (const auto id : variant.warns) CHECK(shipped::suites().catalogue.canonical(id).has_value());
  }
  for (const auto& variant : refnode::variants()) {
    for (const auto word : variant.excludes) {
      INFO(variant.id << " excludes " << word);
      CHECK((ids.contains(word) || groups.contains(word)));
    }
  }
}

TEST_CASE("the same seed draws the same combination") {
  CHECK(cli::draw_combination(7, 3).text() == cli::draw_combination(7, 3).text());
  CHECK(cli::draw_combination(7, 3).text() != cli::draw_combination(7, 4).text());
}
