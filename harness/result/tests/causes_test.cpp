// SPDX-License-Identifier: Apache-2.0
#include "result/causes.hpp"

#include <algorithm>

#include "catch.hpp"
#include "result/services.hpp"

using namespace conform;
using namespace conform::result;

namespace {

CaseResult failed(const std::string& id, const std::string& requirement, const std::string& deviation = {},
                  std::optional<Index> object = {}) {
  CaseResult out;
  out.id = id;
  out.verdict = Verdict::fail;
  Finding finding;
  finding.requirement = requirement;
  finding.deviation = deviation;
  finding.object = object;
  finding.frames_seen = 10;
  Judgement judgement;
  judgement.requirement = requirement;
  judgement.verdict = Verdict::fail;
  judgement.findings.push_back(finding);
  out.judgements.push_back(judgement);
  return out;
}

CaseResult answered(CaseResult one, std::initializer_list<std::uint8_t> bytes) {
  EvidenceFrame frame;
  frame.frame = can::data_frame(CanId(0x581), bytes);
  frame.decisive = true;
  one.judgements[0].findings[0].evidence = {frame};
  return one;
}

void add(CaseResult& to, const std::string& requirement) {
  to.judgements.push_back(failed(to.id, requirement).judgements.front());
}

}  // namespace

TEST_CASE("failures of one part of a device are one cause, told by the rule nearest to the frame") {
  RunResult run;
  run.cases = {failed("a", "OD-1017-05"), failed("b", "EC-HBP-02"), failed("c", "EC-HBP-03")};
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 1);
  CHECK(causes[0].about == "heartbeat producer");
  CHECK(causes[0].cases.size() == 3);
  CHECK(causes[0].requirements.size() == 3);
}

TEST_CASE("failures of two parts are two causes, the one with more cases first") {
  RunResult run;
  run.cases = {failed("a", "SYNC-CON-01"), failed("b", "EC-HBP-02"), failed("c", "EC-HBP-03")};
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 2);
  CHECK(causes[0].about == "heartbeat producer");
  CHECK(causes[1].about == "SYNC");
}

TEST_CASE("a deviation that three parts share is one cause, told by a rule about entries in general") {
  RunResult run;
  const std::string same = "confirmed instead of refused";
  run.cases = {failed("a", "OD-1000-02", same, Index(0x1000)), failed("b", "OD-1003-08", same, Index(0x1003)),
               failed("c", "OD-ACC-01", same, Index(0x1400)), failed("d", "OD-1200-04", same, Index(0x1200))};
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 1);
  CHECK(causes[0].primary.finding->requirement == "OD-ACC-01");
}

TEST_CASE("a rule about entries in general belongs to the part whose own rule is broken as well") {
  RunResult run;
  run.cases = {failed("a", "OD-GEN-17", {}, Index(0x1014)), failed("b", "OD-1014-01", {}, Index(0x1014))};
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 1);
  CHECK(causes[0].primary.finding->requirement == "OD-1014-01");
}

TEST_CASE("what fails only where something else fails as well has no cause of its own") {
  RunResult run;
  run.cases = {failed("a", "PDO-TX-05"), failed("b", "PDO-TX-06")};
  add(run.cases[0], "SYNC-CON-01");
  CHECK(causes_of(run).size() == 1);
  run.cases.push_back(failed("c", "SYNC-CON-02"));
  CHECK(causes_of(run).size() == 2);
}

TEST_CASE("a frame that breaks a rule by itself is the cause of what a scenario wanted of it") {
  RunResult run;
  run.cases = {failed("a", "SDO-SUP-01"), failed("b", "SDO-GEN-02")};
  run.cases[0].judgements[0].findings[0].broken_rules = {"SDO-GEN-02"};
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 1);
  CHECK(causes[0].primary.finding->requirement == "SDO-GEN-02");
}

TEST_CASE("what cannot be seen without a broken rule is told with it, though it belongs to another part") {
  RunResult run;
  run.cases = {failed("a", "OD-1010-10"), failed("b", "EC-HBP-05"), failed("c", "OD-1020-04")};
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 1);
  CHECK(causes[0].primary.finding->requirement == "OD-1010-10");
  CHECK(causes[0].requirements.size() == 3);
}

TEST_CASE("a second fault of a part stays a cause of its own when another of its rules rests on the first") {
  RunResult run;
  run.cases = {failed("a", "OD-1010-10"), failed("b", "EC-HBP-05"), failed("c", "EC-HBP-12")};
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 2);
  CHECK(std::ranges::any_of(causes, [](const Cause& cause) {
    return cause.primary.finding->requirement == "EC-HBP-12" && cause.requirements.size() == 1;
  }));
}

TEST_CASE("one rule of two kinds of transfer is one cause, told by the kind that comes first") {
  RunResult run;
  run.cases = {failed("a", "SDO-BDN-22"), failed("b", "SDO-SUP-20"), failed("c", "SDO-BUP-21")};
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 1);
  CHECK(causes[0].primary.finding->requirement == "SDO-SUP-20");
}

TEST_CASE("no scenario explains anything by the form of a frame that no monitor complains about") {
  RunResult run;
  run.cases = {failed("a", "SDO-GEN-02", "no answer"), failed("b", "OD-GEN-04", "no answer", Index(0x1030))};
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 1);
  CHECK(causes[0].primary.finding->requirement == "OD-GEN-04");
}

TEST_CASE("an SDO rule broken about one object, which breaks its own rule, is that object's fault") {
  RunResult run;
  run.cases = {failed("a", "SDO-BDN-01", "not what was written", Index(0x1017)),
               failed("b", "OD-1017-03", "not what was written", Index(0x1017)), failed("c", "EC-HBP-02")};
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 1);
  CHECK(causes[0].primary.finding->requirement == "OD-1017-03");
}

TEST_CASE("a server whose uploads are wrong explains what is read, and not what is heard") {
  RunResult run;
  run.cases = {answered(failed("a", "SDO-UPL-02", {}, Index(0x1001)), {0x43, 0x01, 0x10, 0, 1, 0, 0, 0}),
               answered(failed("b", "OD-1005-01", {}, Index(0x1005)), {0x43, 0x05, 0x10, 0, 0, 0, 0, 0}),
               answered(failed("c", "OD-1400-15", {}, Index(0x1400)), {0x43, 0x00, 0x14, 2, 0xFF, 0, 0, 0}),
               failed("d", "EC-HBP-01")};
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 2);
  CHECK(causes[0].primary.finding->requirement == "SDO-UPL-02");
  CHECK(causes[0].requirements.size() == 3);
  CHECK(causes[1].primary.finding->requirement == "EC-HBP-01");
}

TEST_CASE("cases without ground are told with the cause that took it") {
  RunResult run;
  run.cases = {failed("a", "EC-HBP-02"), failed("b", "SYNC-CON-01"), {}};
  run.cases[2].id = "c";
  run.cases[2].verdict = Verdict::inconclusive;
  run.cases[2].rests_on = "EC-HBP-02";
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 2);
  CHECK(causes[0].about == "heartbeat producer");
  REQUIRE(causes[0].resting.size() == 1);
  CHECK(causes[0].resting[0]->id == "c");
}

TEST_CASE("a warning alone is a cause, behind every failure") {
  RunResult run;
  run.cases = {failed("a", "SYNC-CON-05"), failed("b", "EC-HBP-02")};
  run.cases[0].judgements[0].verdict = Verdict::warn;
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 2);
  CHECK(causes[1].verdict == Verdict::warn);
  CHECK(causes[1].about == "SYNC");
}

TEST_CASE("a part of the device explains nothing about an entry of another part") {
  RunResult run;
  run.cases = {failed("a", "OD-1400-15", {}, Index(0x1400)), failed("b", "OD-1400-01", {}, Index(0x1400)),
               failed("c", "OD-1201-03", {}, Index(0x1201)), failed("d", "OD-DSC-03", {}, Index(0x1201))};
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 2);
  CHECK(causes[0].about == "RPDO");
  CHECK(causes[1].about == "additional SDO channels");
  CHECK(causes[1].cases.size() == 2);
}

TEST_CASE("what fails first in a case is not hidden by what fails behind it") {
  RunResult run;
  run.cases = {failed("a", "OD-1012-04", {}, Index(0x1012)), failed("b", "SDO-DNL-03", {}, Index(0x2000))};
  add(run.cases[0], "SDO-DNL-03");
  auto& behind = run.cases[0].judgements[1].findings[0];
  SECTION("behind it") {
    behind.frames_seen = 12;
    CHECK(causes_of(run).size() == 2);
  }
  SECTION("before it") {
    behind.frames_seen = 8;
    CHECK(causes_of(run).size() == 1);
  }
}

TEST_CASE("services that are tried with the same object have nothing else in common") {
  RunResult run;
  run.cases = {
      answered(failed("a", "SDO-BUP-17", "no answer", Index(0x2000)), {0x60, 0, 0x20, 1, 0, 0, 0, 0}),
      answered(failed("b", "SDO-DNL-03", "not what was written", Index(0x2000)),
               {0x60, 0, 0x20, 1, 0, 0, 0, 0})};
  CHECK(causes_of(run).size() == 2);
}

TEST_CASE(
    "uploads of the wrong length explain no download that was confirmed, and no access that was refused") {
  RunResult run;
  run.cases = {answered(failed("a", "SDO-UPL-04", {}, Index(0x2000)), {0x43, 0, 0x20, 1, 1, 2, 3, 0}),
               answered(failed("b", "OD-1022-03", "confirmed instead of any abort", Index(0x1022)),
                        {0x60, 0x22, 0x10, 0, 0, 0, 0, 0}),
               answered(failed("c", "OD-1005-04", "abort 0601 0000h", Index(0x1005)),
                        {0x80, 0x05, 0x10, 0, 0, 0, 0x01, 0x06})};
  CHECK(causes_of(run).size() == 3);
  run.cases[2] = answered(failed("c", "OD-1005-04", "abort 0607 0012h", Index(0x1005)),
                          {0x80, 0x05, 0x10, 0, 0x12, 0, 0x07, 0x06});
  CHECK(causes_of(run).size() == 2);
}

TEST_CASE("a wrong abort that two transfer services give is one cause") {
  RunResult run;
  run.cases = {failed("a", "SDO-SUP-05", "abort 0609 0030h"), failed("b", "SDO-SDN-05", "abort 0609 0030h")};
  CHECK(causes_of(run).size() == 1);
  run.cases[1] = failed("b", "SDO-SDN-05", "abort 0800 0000h");
  CHECK(causes_of(run).size() == 2);
}
