// SPDX-License-Identifier: Apache-2.0
#include "result/entries.hpp"

#include "catch.hpp"

using namespace conform;
using namespace conform::result;

namespace {

constexpr Multiplexer vendor{Index(0x1018), SubIndex(1)};
constexpr Multiplexer heartbeat{Index(0x1017), SubIndex(0)};

CaseResult found(const std::string& instance, const std::string& requirement, Verdict verdict,
                 const std::string& step) {
  CaseResult out;
  out.id = "a/case";
  out.instance = instance;
  out.verdict = verdict;
  Judgement judgement{requirement, verdict, {}};
  if (verdict != Verdict::pass) {
    Finding finding;
    finding.verdict = verdict;
    finding.step = step;
    finding.actual = "confirmed";
    judgement.findings.push_back(finding);
  }
  out.judgements.push_back(judgement);
  return out;
}

EntryFacts entry(Multiplexer object) {
  EntryFacts out;
  out.object = object;
  out.presence = present;
  return out;
}

}  // namespace

TEST_CASE("a finding belongs to the entry that its case is played for, or that its step names") {
  RunResult run;
  run.cases = {found("1018h:01", "OD-ACC-02", Verdict::fail, "download 1018h:01 = 0000 0001h"),
               found("", "OD-1017-05", Verdict::warn, "upload 1017h:00"),
               found("", "SDO-SUP-01", Verdict::fail, "upload 1017h:00"),
               found("1018h:01", "OD-LEN-04", Verdict::pass, "")};
  const auto judged = judged_entries(run);
  REQUIRE(judged.size() == 2);
  const auto& constant = judged.at(vendor);
  CHECK(constant.cases == std::vector<const CaseResult*>{&run.cases[0], &run.cases[3]});
  REQUIRE(constant.differing.size() == 1);
  CHECK(constant.differing[0].aspect == "access");
  CHECK(constant.differing[0].where == &run.cases[0]);
  CHECK(constant.differing[0].came == "confirmed");
  // A rule about transfers says nothing of the entry that lent itself to it.
  const auto& other = judged.at(heartbeat);
  CHECK(other.cases.empty());
  REQUIRE(other.differing.size() == 1);
  CHECK(other.differing[0].aspect == "rule");
  CHECK(other.differing[0].verdict == Verdict::warn);
}

TEST_CASE("a requirement differs once, as bad as it was found") {
  RunResult run;
  run.cases = {found("1018h:01", "OD-ACC-02", Verdict::warn, ""),
               found("1018h:01", "OD-ACC-02", Verdict::fail, ""),
               found("1018h:01", "OD-ACC-02", Verdict::warn, "")};
  const auto judged = judged_entries(run);
  REQUIRE(judged.at(vendor).differing.size() == 1);
  CHECK(judged.at(vendor).differing[0].where == &run.cases[1]);
}

TEST_CASE("what the survey saw differs where no requirement tells more") {
  RunResult run;
  run.dictionary = {entry(heartbeat), entry(vendor)};
  run.dictionary[0].claimed = true;
  run.dictionary[0].presence = absent;
  run.dictionary[0].refusal = "abort 0602 0000h";
  run.dictionary[1].length = 4;
  run.dictionary[1].size = 2;
  auto judged = judged_entries(run);
  CHECK(judged.at(heartbeat).differing.at(0).aspect == "presence");
  CHECK(judged.at(heartbeat).differing.at(0).came == "abort 0602 0000h");
  CHECK(judged.at(vendor).differing.at(0).came == "2 bytes instead of 4");
  run.cases = {found("1018h:01", "OD-LEN-04", Verdict::fail, "upload 1018h:01")};
  judged = judged_entries(run);
  REQUIRE(judged.at(vendor).differing.size() == 1);
  CHECK(judged.at(vendor).differing[0].requirement == "OD-LEN-04");
}

TEST_CASE("an entry that nobody claims may be absent, and one of open length has any") {
  RunResult run;
  run.dictionary = {entry(heartbeat), entry(vendor)};
  run.dictionary[0].presence = absent;
  run.dictionary[1].size = 7;
  CHECK(judged_entries(run).empty());
}
