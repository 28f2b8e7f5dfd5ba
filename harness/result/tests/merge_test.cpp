// SPDX-License-Identifier: Apache-2.0
#include "result/merge.hpp"

#include "catch.hpp"

using namespace conform;
using namespace conform::result;
using namespace std::chrono_literals;

namespace {

CaseResult played(const std::string& id, Verdict verdict, std::size_t first, std::size_t end) {
  CaseResult out;
  out.id = id;
  out.suite = "cia301/x";
  out.verdict = verdict;
  out.first_frame = first;
  out.end_frame = end;
  return out;
}

CaseResult monitor(Verdict verdict, std::size_t expectations, std::size_t frames) {
  CaseResult out = played("monitor/m", verdict, 0, frames);
  out.suite = "monitor";
  Judgement judgement{.requirement = "R-1", .verdict = verdict, .findings = {}, .expectations = expectations};
  if (verdict == Verdict::fail) {
    Finding finding;
    finding.frames_seen = 3;
    finding.evidence.push_back({.frame = {}, .time = BusTime(1s), .meaning = {}});
    judgement.findings.push_back(finding);
  }
  out.judgements.push_back(judgement);
  return out;
}

NamedRun part(std::size_t number, std::size_t of, std::vector<CaseResult> cases) {
  NamedRun out{"part" + std::to_string(number) + ".json", {}};
  out.run.tool = "canopen-conform 1";
  out.run.elapsed = 10s;
  out.run.cases = std::move(cases);
  out.run.properties = {{"run.shard", std::to_string(number) + "/" + std::to_string(of)}, {"run.seed", "1"}};
  out.run.requirements = {{"R-1", "", "", "", ""}};
  return out;
}

std::vector<NamedRun> two_parts() {
  return {part(2, 2, {played("b", Verdict::pass, 0, 7), monitor(Verdict::fail, 4, 9)}),
          part(1, 2, {played("a", Verdict::pass, 0, 5), monitor(Verdict::pass, 6, 8)})};
}

}  // namespace

TEST_CASE("parts of a run are one run, as if they had been played one after the other") {
  const auto whole = merge_parts(two_parts());
  REQUIRE(whole);
  REQUIRE(whole->cases.size() == 3);
  CHECK(whole->cases[0].id == "a");
  CHECK(whole->cases[1].id == "b");
  CHECK(whole->cases[1].first_frame == 8);
  CHECK(whole->cases[1].end_frame == 15);
  CHECK(whole->elapsed == 20s);
  CHECK_FALSE(whole->aborted);
  CHECK(property_of(*whole, "run.parts") == "2");
  CHECK(property_of(*whole, "run.shard").empty());
}

TEST_CASE("what a monitor found in one part counts for the whole, and what it saw adds up") {
  const auto whole = merge_parts(two_parts());
  REQUIRE(whole);
  const auto& monitor = whole->cases.back();
  CHECK(monitor.verdict == Verdict::fail);
  REQUIRE(monitor.judgements.size() == 1);
  CHECK(monitor.judgements[0].expectations == 10);
  REQUIRE(monitor.judgements[0].findings.size() == 1);
  CHECK(monitor.judgements[0].findings[0].frames_seen == 11);
  CHECK(monitor.judgements[0].findings[0].evidence[0].time == BusTime(11s));
  CHECK(monitor.end_frame == 17);
  CHECK(exit_code(*whole) == 1);
}

TEST_CASE("a whole with a part missing, or with one that stopped early, is no whole") {
  auto parts = two_parts();
  SECTION("missing") {
    parts.erase(parts.begin());
    const auto whole = merge_parts(parts);
    REQUIRE(whole);
    CHECK(whole->aborted == "part 2 of 2 is missing");
    CHECK(exit_code(*whole) == 3);
  }
  SECTION("stopped") {
    parts[1].run.aborted = "the bus went away";
    const auto whole = merge_parts(parts);
    REQUIRE(whole);
    CHECK(whole->aborted == "part 1 of 2: the bus went away");
  }
}

TEST_CASE("parts of different runs are not joined, and the first difference is told with both files") {
  auto parts = two_parts();
  SECTION("another seed") {
    parts[0].run.properties[1].value = "2";
    const auto whole = merge_parts(parts);
    REQUIRE_FALSE(whole);
    CHECK(whole.error().what == "are no parts of one run: run.seed is '2' in the one and '1' in the other");
    CHECK(whole.error().where == "part2.json and part1.json");
  }
  SECTION("the same part twice") {
    parts[0] = parts[1];
    parts[0].name = "again.json";
    const auto whole = merge_parts(parts);
    REQUIRE_FALSE(whole);
    CHECK(whole.error().what == "is part 1 of 2 as well as again.json");
  }
  SECTION("another number of parts") {
    parts[1].run.properties[0].value = "1/3";
    CHECK_FALSE(merge_parts(parts));
  }
  SECTION("no part at all") {
    parts[1].run.properties.clear();
    CHECK_FALSE(merge_parts(parts));
  }
}

TEST_CASE("a waiver that one part needed is needed by the whole") {
  auto parts = two_parts();
  const WaiverUse use{.requirement = "R-1",
                      .case_name = {},
                      .reason = "known",
                      .owner = {},
                      .ticket = {},
                      .expires = {},
                      .place = "w.yaml:3",
                      .cases = {"b"},
                      .state = "used",
                      .verdict = Verdict::waived};
  auto unused = use;
  unused.cases.clear();
  unused.state = "not needed any more: nothing that it covers failed";
  unused.verdict = Verdict::warn;
  parts[0].run.waivers = {use};
  parts[1].run.waivers = {unused};
  const auto whole = merge_parts(parts);
  REQUIRE(whole);
  REQUIRE(whole->waivers.size() == 1);
  CHECK(whole->waivers[0].state == "used");
  CHECK(whole->waivers[0].verdict == Verdict::waived);
  CHECK(whole->waivers[0].cases == std::vector<std::string>{"b"});
}
