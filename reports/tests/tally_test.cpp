// SPDX-License-Identifier: Apache-2.0
#include "reports/tally.hpp"

#include "catch.hpp"
#include "fixture.hpp"
#include "reports/console.hpp"
#include "reports/markdown.hpp"
#include "reports/phrases.hpp"

using namespace conform;
using namespace conform::reports;
using result::RunResult;
using result::Verdict;

namespace {

std::optional<Verdict> verdict_of(const RunResult& run, const std::string& id) {
  for (const RequirementVerdict& one : requirement_verdicts(run)) {
    if (one.id == id) return one.verdict;
  }
  FAIL("no such requirement");
  return std::nullopt;
}

}  // namespace

TEST_CASE("What the user could give is counted over the cases that want it, most first") {
  result::RunResult run;
  const auto add = [&run](result::Verdict verdict, const std::vector<std::string>& wants) {
    result::CaseResult one;
    one.verdict = verdict;
    for (const auto& want : wants) one.wants.push_back({"object", want});
    run.cases.push_back(one);
  };
  add(result::Verdict::not_applicable, {"a"});
  add(result::Verdict::not_applicable, {"b", "a"});
  add(result::Verdict::not_applicable, {"b"});
  add(result::Verdict::not_applicable, {"b"});
  add(result::Verdict::pass, {"a"});
  const auto wants = reports::tally_wants(run);
  REQUIRE(wants.size() == 2);
  CHECK(wants[0].want.text == "b");
  CHECK(wants[0].cases == 3);
  CHECK(wants[1].cases == 2);
}

TEST_CASE("Reasons why cases do not apply are one when they differ in numbers only") {
  result::RunResult run;
  for (const char* reason : {"1401h:01 is absent: abort 0602 0000h", "1402h:02 is absent: abort 0609 0011h",
                             "1402h:02 is not writable: const", "bit 31 of 1800h:01 is 1 (C000 0185h), not 0",
                             "bit 30 of 1801h:01 is 0 (8000 0285h), not 1"}) {
    result::CaseResult one;
    one.verdict = result::Verdict::not_applicable;
    one.reason = reason;
    run.cases.push_back(one);
  }
  const auto groups = reports::group_by_reason(run, result::Verdict::not_applicable);
  REQUIRE(groups.size() == 3);
  CHECK(groups[0].cases.size() == 2);
  CHECK(groups[0].varies);
  CHECK_FALSE(groups[1].varies);
  CHECK(groups[2].cases.size() == 2);
}

TEST_CASE("A requirement has the worst verdict of all its cases") {
  RunResult run = testing::sample_run();
  CHECK(verdict_of(run, "OD-1003-06") == Verdict::fail);
  CHECK(verdict_of(run, "OD-1003-07") == Verdict::pass);
  CHECK(verdict_of(run, "EC-HB-01") == Verdict::inconclusive);
  CHECK(verdict_of(run, "PDO-MAP-04") == Verdict::not_applicable);
  CHECK(verdict_of(run, "PDO-MAP-05") == Verdict::error);
  run.cases[0].judgements.push_back({"OD-1003-07", Verdict::warn, {}, 1});
  CHECK(verdict_of(run, "OD-1003-07") == Verdict::warn);
}

TEST_CASE("An instance that does not apply does not hide one that passed") {
  RunResult run = testing::sample_run();
  auto other = run.cases[0];
  other.verdict = Verdict::not_applicable;
  other.judgements.clear();
  run.cases.push_back(other);
  CHECK(verdict_of(run, "OD-1000-01") == Verdict::pass);
}

TEST_CASE("A requirement that only another branch would judge has no verdict") {
  RunResult run = testing::sample_run();
  run.cases[0].requirements.push_back("OD-1000-99");
  CHECK_FALSE(verdict_of(run, "OD-1000-99").has_value());
  CHECK(sum(tally_by_area(run)).not_judged == 1);
}

TEST_CASE("Areas count requirements and add up") {
  const RunResult run = testing::sample_run();
  const auto rows = tally_by_area(run);
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].area == "Error control");
  CHECK(rows[2].area == "Pre-defined error field (1003h)");
  CHECK(rows[2].counts.fail == 1);
  CHECK(rows[2].counts.warn == 1);
  CHECK(rows[2].counts.pass == 1);
  CHECK(sum(rows).counts.total() == run.requirements.size());
}

TEST_CASE("What is waived is counted in the sum of the areas, and shown by every table") {
  auto run = testing::sample_run();
  for (auto& one : run.cases) {
    for (auto& judgement : one.judgements) {
      if (judgement.verdict != Verdict::fail) continue;
      judgement.verdict = one.verdict = Verdict::waived;
      judgement.waived = "later";
    }
  }
  const auto total = sum(tally_by_area(run));
  CHECK(total.counts.waived > 0);
  CHECK(total.counts.fail == 0);
  CHECK(summary(run, Style{}).find("   waived") != std::string::npos);
  CHECK(markdown_evidence(run).find("| pass | waived | warn |") != std::string::npos);
}

TEST_CASE("Cases with the same reason are one group") {
  RunResult run = testing::sample_run();
  run.cases.push_back(run.cases[5]);
  const auto groups = group_by_reason(run, Verdict::not_applicable);
  REQUIRE(groups.size() == 1);
  CHECK(groups[0].cases.size() == 2);
}

TEST_CASE("Frames are written as can-utils write them") {
  can::Frame frame = can::data_frame(CanId{0x80}, {});
  CHECK(candump_frame(frame) == "080#");
  CHECK(candump_frame(can::data_frame(CanId{0x603}, {0x2F, 0x03})) == "603#2F03");
  CHECK(candump_frame(can::remote_frame(CanId{0x703}, 1)) == "703#R1");
  CHECK(candump_frame(can::remote_frame(CanId{0x703}, 0)) == "703#R");
  frame.extended = true;
  CHECK(candump_frame(frame) == "00000080#");
  frame.error = true;
  frame.id = 4;
  CHECK(candump_frame(frame) == "20000004#");
  can::Frame overlong = can::data_frame(CanId{0x123}, {1, 2, 3, 4, 5, 6, 7, 8});
  overlong.dlc = 15;
  CHECK(candump_frame(overlong) == "123#0102030405060708_F");
}

TEST_CASE("Many bytes come in rows, and not without end") {
  CHECK(byte_rows(Bytes{1, 2}) == std::vector<std::string>{"01 02"});
  CHECK(byte_rows(Bytes(300, 0x41)).size() == 17);
  CHECK(byte_rows(Bytes(300, 0x41)).back() == "... 44 bytes more");
}
