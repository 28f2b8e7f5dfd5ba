// SPDX-License-Identifier: Apache-2.0
#include "result/cause_captures.hpp"

#include "catch.hpp"

using namespace conform;
using namespace conform::result;

namespace {

RunResult failed(const std::string& id, const std::string& requirement) {
  CaseResult one;
  one.id = id;
  one.verdict = Verdict::fail;
  one.first_frame = 100;
  one.end_frame = 120;
  Finding finding;
  finding.requirement = requirement;
  EvidenceFrame frame;
  frame.capture_index = 130;
  finding.evidence.push_back(frame);
  Judgement judgement;
  judgement.requirement = requirement;
  judgement.verdict = Verdict::fail;
  judgement.findings.push_back(finding);
  one.judgements.push_back(judgement);
  RunResult out;
  out.cases.push_back(one);
  return out;
}

std::string name_of(const RunResult& run) {
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 1);
  return capture_name(causes[0], 1);
}

}  // namespace

TEST_CASE("a capture of a cause is called by number, requirement and case, for every file system") {
  CHECK(name_of(failed("cia301/emergency/history/full[1003h:00]", "OD-1003-06")) ==
        "cause-01-OD-1003-06-cia301-emergency-history-full-1003h-00.pcapng");
  const auto hostile = name_of(failed("../../\x1b[2J\n*?<>|:\"\\ .", "a/b"));
  CHECK(hostile.starts_with("cause-01-a-b-"));
  CHECK(hostile.find_first_of("/\\\x1b\n*?<>|:\" ") == std::string::npos);
  CHECK(name_of(failed(std::string(5000, 'x'), "R")).size() < 250);
}

TEST_CASE("the names of such captures are recognised, and no others") {
  CHECK(is_capture_name(name_of(failed("a", "R"))));
  CHECK(is_capture_name("cause-123-x.pcapng"));
  for (const auto* name :
       {"cause-.pcapng", "cause-1.pcapng", "run.pcapng", "cause-xx-a.pcapng", "cause-01-a.pcap"})
    CHECK_FALSE(is_capture_name(name));
}

TEST_CASE("the frames of a cause are those of its case and of its evidence") {
  const auto run = failed("a", "R");
  const auto causes = causes_of(run);
  const auto range = frames_of(causes[0], run);
  REQUIRE(range);
  CHECK(range->first == 100);
  CHECK(range->end == 131);
}

TEST_CASE("of a finding of a monitor the frames are those of the case that ran meanwhile") {
  auto run = failed("heartbeat", "R");
  run.cases[0].suite = "monitor";
  run.cases[0].first_frame = 0;
  run.cases[0].end_frame = 100'000;
  run.cases[0].judgements[0].findings[0].during = "cia301/sdo/upload";
  CaseResult meanwhile;
  meanwhile.id = "cia301/sdo/upload";
  meanwhile.first_frame = 125;
  meanwhile.end_frame = 140;
  meanwhile.verdict = Verdict::pass;
  run.cases.push_back(meanwhile);
  const auto causes = causes_of(run);
  REQUIRE(causes.size() == 1);
  const auto range = frames_of(causes[0], run);
  REQUIRE(range);
  CHECK(range->first == 125);
  CHECK(range->end == 140);
}
