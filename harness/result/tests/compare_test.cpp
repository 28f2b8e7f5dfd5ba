// SPDX-License-Identifier: Apache-2.0
#include "result/compare.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "catch.hpp"

using namespace conform;
using namespace conform::result;

namespace {

CaseResult judged(const std::string& id, const std::string& requirement, Verdict verdict,
                  const std::string& instance = {}) {
  CaseResult out;
  out.id = id;
  out.instance = instance;
  out.suite = "suite";
  out.requirements = {requirement};
  out.verdict = verdict;
  if (verdict == Verdict::not_applicable || verdict == Verdict::inconclusive || verdict == Verdict::error) {
    out.reason = "for a reason";
    return out;
  }
  Judgement judgement;
  judgement.requirement = requirement;
  judgement.verdict = verdict;
  if (verdict != Verdict::pass) {
    Finding finding;
    finding.verdict = verdict;
    finding.requirement = requirement;
    finding.step = "upload 1017h:00";
    finding.frames_seen = 10;
    judgement.findings.push_back(finding);
  }
  out.judgements.push_back(judgement);
  return out;
}

CaseResult answered(const std::string& step, const std::string& actual) {
  auto out = judged("case", "OD-1018-01", Verdict::pass);
  out.judgements[0].decided_by = DecidingStep{{}, step, actual};
  return out;
}

RunResult run_of(std::vector<CaseResult> cases) {
  RunResult out;
  out.cases = std::move(cases);
  return out;
}

std::size_t answers_between(const std::string& step, const std::string& before, const std::string& after) {
  const auto old = run_of({answered(step, before)}), now = run_of({answered(step, after)});
  const auto comparison = compare(old, now);
  return comparison.observed.size() + comparison.entries.size();
}

/// "2000h:01: 1 -> 2", with a '~' in front of what may be a value of the process.
std::vector<std::string> entries_between(const RunResult& before, const RunResult& after) {
  std::vector<std::string> out;
  for (const auto& each : compare(before, after).entries)
    out.push_back((each.is_process ? "~" : "") + to_string(each.object) + ": " + each.before + " -> " +
                  each.after);
  return out;
}
using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("a run is the same as itself") {
  const auto run = run_of({judged("a", "OD-1017-05", Verdict::fail), judged("b", "EC-HBP-02", Verdict::pass),
                           judged("c", "EC-HBP-03", Verdict::inconclusive)});
  const auto comparison = compare(run, run);
  CHECK(comparison.is_same());
  CHECK(comparison.known_failures == 1);
  CHECK(exit_code(comparison, true) == 0);
}

TEST_CASE("a failure that was none is a new cause, and red") {
  const auto old =
      run_of({judged("a", "OD-1017-05", Verdict::pass), judged("b", "SYNC-CON-01", Verdict::fail)});
  const auto now =
      run_of({judged("a", "OD-1017-05", Verdict::fail), judged("b", "SYNC-CON-01", Verdict::fail)});
  const auto comparison = compare(old, now);
  REQUIRE(comparison.new_causes.size() == 1);
  CHECK(comparison.new_causes[0].fresh[0].finding->requirement == "OD-1017-05");
  CHECK_FALSE(comparison.new_causes[0].has_spread());
  REQUIRE(comparison.worse.size() == 1);
  CHECK(comparison.worse[0].requirement == "OD-1017-05");
  CHECK(comparison.known_failures == 1);
  CHECK(exit_code(comparison, false) == 1);
}

TEST_CASE("a failure that is gone is better, and told") {
  const auto old = run_of({judged("a", "OD-1017-05", Verdict::fail)});
  const auto now = run_of({judged("a", "OD-1017-05", Verdict::pass)});
  const auto comparison = compare(old, now);
  REQUIRE(comparison.gone_causes.size() == 1);
  CHECK(comparison.gone_causes[0].left == 0);
  CHECK(comparison.better.size() == 1);
  CHECK_FALSE(comparison.is_same());
  CHECK(exit_code(comparison, false) == 0);
}

TEST_CASE("a failure that nobody tried again is not gone") {
  const auto old =
      run_of({judged("a", "OD-1017-05", Verdict::fail, "1"), judged("a", "OD-1017-05", Verdict::pass, "2")});
  const auto now =
      run_of({judged("a", "OD-1017-05", Verdict::pass, "2"), judged("a", "OD-1017-05", Verdict::pass, "3")});
  CHECK(compare(old, now).is_same());
}

TEST_CASE("a known failure that shows with another object of a sample is not new") {
  const auto old = run_of({judged("a", "OD-1400-15", Verdict::fail, "1401h:00")});
  const auto now = run_of({judged("a", "OD-1400-15", Verdict::fail, "1402h:00")});
  CHECK(compare(old, now).is_same());
}

TEST_CASE("a known failure that shows where it passed before has spread, and is red") {
  const auto old =
      run_of({judged("a", "OD-1400-15", Verdict::fail), judged("b", "OD-1400-15", Verdict::pass)});
  const auto now =
      run_of({judged("a", "OD-1400-15", Verdict::fail), judged("b", "OD-1400-15", Verdict::fail)});
  const auto comparison = compare(old, now);
  REQUIRE(comparison.new_causes.size() == 1);
  CHECK(comparison.new_causes[0].has_spread());
  CHECK(comparison.new_causes[0].fresh[0].owner->id == "b");
  CHECK(exit_code(comparison, false) == 1);
}

TEST_CASE("a cause of which something is left is gone in part") {
  const auto old =
      run_of({judged("a", "OD-1400-15", Verdict::fail), judged("b", "OD-1400-15", Verdict::fail)});
  const auto now =
      run_of({judged("a", "OD-1400-15", Verdict::fail), judged("b", "OD-1400-15", Verdict::pass)});
  const auto comparison = compare(old, now);
  REQUIRE(comparison.gone_causes.size() == 1);
  CHECK(comparison.gone_causes[0].mended == 1);
  CHECK(comparison.gone_causes[0].left == 1);
}

TEST_CASE("what was found in a case that was not decided afterwards is known all the same") {
  auto run = run_of({judged("a", "OD-1400-15", Verdict::pass), judged("b", "OD-1400-15", Verdict::warn)});
  run.cases[1].judgements[0].verdict = run.cases[1].verdict = Verdict::inconclusive;
  CHECK(compare(run, run).is_same());
}

TEST_CASE("what a case shows no more, because it takes another branch, is gone") {
  const auto old = run_of({judged("a", "OD-1400-15", Verdict::fail)});
  auto now = run_of({judged("a", "OD-1400-16", Verdict::pass)});
  now.cases[0].requirements.emplace_back("OD-1400-15");
  REQUIRE(compare(old, now).gone_causes.size() == 1);
}

TEST_CASE("a new warning is told, and red only where that is asked for") {
  const auto old = run_of({judged("a", "OD-1017-05", Verdict::pass)});
  const auto now = run_of({judged("a", "OD-1017-05", Verdict::warn)});
  const auto comparison = compare(old, now);
  REQUIRE(comparison.new_causes.size() == 1);
  CHECK(exit_code(comparison, false) == 0);
  CHECK(exit_code(comparison, true) == 1);
}

TEST_CASE("a waived failure is told and not red, and is one again when nobody answers for it") {
  const auto good = run_of({judged("a", "OD-1017-05", Verdict::pass)});
  const auto waived = run_of({judged("a", "OD-1017-05", Verdict::waived)});
  const auto failed = run_of({judged("a", "OD-1017-05", Verdict::fail)});
  CHECK(compare(waived, waived).is_same());
  CHECK(compare(good, waived).worse.size() == 1);
  CHECK(exit_code(compare(good, waived), true) == 0);
  CHECK(exit_code(compare(waived, failed), false) == 1);
  CHECK(compare(failed, waived).better.size() == 1);
  CHECK(compare(failed, waived).gone_causes.empty());
}

TEST_CASE("a warning that fails now is new") {
  const auto old = run_of({judged("a", "OD-1017-05", Verdict::warn)});
  const auto now = run_of({judged("a", "OD-1017-05", Verdict::fail)});
  CHECK(exit_code(compare(old, now), false) == 1);
  CHECK(exit_code(compare(now, old), false) == 0);
}

TEST_CASE("new failures come before new warnings, new causes before those that have spread") {
  const auto old =
      run_of({judged("a", "EC-HBP-02", Verdict::fail), judged("b", "EC-HBP-02", Verdict::pass),
              judged("c", "SYNC-CON-01", Verdict::pass), judged("d", "TIME-PRO-01", Verdict::pass)});
  const auto now =
      run_of({judged("a", "EC-HBP-02", Verdict::fail), judged("b", "EC-HBP-02", Verdict::fail),
              judged("c", "SYNC-CON-01", Verdict::fail), judged("d", "TIME-PRO-01", Verdict::warn)});
  const auto comparison = compare(old, now);
  REQUIRE(comparison.new_causes.size() == 3);
  CHECK(comparison.new_causes[0].fresh[0].finding->requirement == "SYNC-CON-01");
  CHECK(comparison.new_causes[1].has_spread());
  CHECK(comparison.new_causes[2].verdict == Verdict::warn);
}

TEST_CASE("what was judged and cannot be decided now is neither red nor green") {
  for (const auto undecided : {Verdict::inconclusive, Verdict::error}) {
    const auto old = run_of({judged("a", "OD-1017-05", Verdict::pass)});
    const auto now = run_of({judged("a", "OD-1017-05", undecided)});
    const auto comparison = compare(old, now);
    REQUIRE(comparison.lost.size() == 1);
    CHECK(exit_code(comparison, false) == 3);
    CHECK(exit_code(compare(now, old), false) == 0);
    CHECK(compare(now, old).gained.size() == 1);
  }
}

TEST_CASE("a rule of which nothing is decided any more is lost, though not all was decided before") {
  const auto old =
      run_of({judged("a", "OD-1017-05", Verdict::pass), judged("b", "OD-1017-05", Verdict::inconclusive)});
  const auto now = run_of(
      {judged("a", "OD-1017-05", Verdict::inconclusive), judged("b", "OD-1017-05", Verdict::inconclusive)});
  CHECK(exit_code(compare(old, now), false) == 3);
}

TEST_CASE("what is not applicable any more is told, and not red") {
  const auto old = run_of({judged("a", "OD-1017-05", Verdict::pass)});
  const auto now = run_of({judged("a", "OD-1017-05", Verdict::not_applicable)});
  const auto comparison = compare(old, now);
  CHECK(comparison.lost.size() == 1);
  CHECK(comparison.observed.size() == 1);
  CHECK(exit_code(comparison, false) == 0);
}

TEST_CASE("what a monitor did not come to see is no difference") {
  auto old = run_of({judged("monitor/x", "EMCY-FMT-03", Verdict::pass)});
  auto now = run_of({judged("monitor/x", "EMCY-FMT-03", Verdict::not_applicable)});
  old.cases[0].suite = now.cases[0].suite = "monitor";
  CHECK(compare(old, now).is_same());
  CHECK(compare(now, old).is_same());
}

TEST_CASE("of a run of some scenarios the others are left out, and it is the same otherwise") {
  const auto old =
      run_of({judged("a", "OD-1017-05", Verdict::pass), judged("b", "EC-HBP-02", Verdict::fail)});
  const auto now = run_of({judged("a", "OD-1017-05", Verdict::pass)});
  const auto comparison = compare(old, now);
  CHECK(comparison.is_same());
  CHECK(comparison.only_in_old == std::vector<std::string>{"EC-HBP-02"});
}

TEST_CASE("another abort code that passes as well is told") {
  CHECK(answers_between("download 1018h:01 = 00h", "abort 0601 0002h (x)", "abort 0800 0000h (y)") == 1);
  CHECK(answers_between("download 1018h:01 = 00h", "abort 0601 0002h (x)", "confirmed") == 1);
  CHECK(answers_between("download 1018h:01 = 00h", "confirmed", "confirmed, 3 segments in 1 sub-blocks") ==
        0);
}

TEST_CASE("a step that was played for many values is compared by its verdict only") {
  CHECK(answers_between("upload 1000h:00", "000F 0191h", "200 of 200 values: 01h: 000F 0191h") == 0);
}

TEST_CASE("an entry that holds another value is told, but none that a device changes by itself") {
  CHECK(answers_between("upload 1018h:03", "0001 0000h", "0002 0000h") == 1);
  CHECK(answers_between("upload 1018h:03 by block", "7 (1 segments in 1 sub-blocks)", "7 (2 segments)") == 0);
  CHECK(answers_between("upload 1013h:00", "00DB FD78h", "008E 7311h") == 0);
}

TEST_CASE("a value that may be one of the process is told, but is no difference") {
  for (const auto* object : {"6000h:01", "2000h:01"}) {
    const auto step = std::string("upload ") + object;
    const auto old = run_of({answered(step, "00h")}), now = run_of({answered(step, "01h")});
    CHECK(entries_between(old, now) == Texts{"~" + std::string(object) + ": 00h -> 01h"});
    CHECK(compare(old, now).is_same());
  }
}

TEST_CASE("an entry that did not stay the same within a run is not told") {
  auto old = run_of({answered("upload 2000h:01", "00h"), answered("upload 2000h:01 by block", "02h")});
  old.cases[1].id = "b";
  auto now = run_of({answered("upload 2000h:01", "01h"), answered("upload 2000h:01 by block", "01h")});
  now.cases[1].id = "b";
  CHECK(entries_between(old, now).empty());
}

TEST_CASE("an entry that is there in one of the runs only is told, in whatever words a run says so") {
  const auto there = run_of({answered("upload 2003h:05", "0005h")});
  const auto asked = run_of({answered("upload 2003h:05", "abort 0609 0011h (sub-index does not exist)")});
  auto walked = run_of(
      {answered("upload 2003h:05",
                "2 of 74 values: 2003h:05: abort 0609 0011h (sub-index does not exist); 2004h:01: 02h")});
  auto left_out = run_of({judged("a", "OD-1000-01", Verdict::not_applicable, "2003h:05")});
  left_out.cases[0].reason = "2003h:05 is absent: abort 0602 0000h (object does not exist)";
  for (const auto& gone : {asked, walked, left_out}) {
    CHECK(entries_between(there, gone) == Texts{"2003h:05: 0005h -> "});
    CHECK(entries_between(gone, there) == Texts{"2003h:05:  -> 0005h"});
    CHECK_FALSE(compare(there, gone).is_same());
    CHECK(entries_between(gone, gone).empty());
  }
  // What comes and goes within a run says nothing.
  auto both = there;
  both.cases.push_back(left_out.cases[0]);
  CHECK(entries_between(both, asked).empty());
}

TEST_CASE("objects belong to the area that their index says") {
  CHECK(area_of(Index(0x1FFF)) == Area::communication);
  CHECK(area_of(Index(0x2000)) == Area::manufacturer);
  CHECK(area_of(Index(0x5FFF)) == Area::manufacturer);
  CHECK(area_of(Index(0x6000)) == Area::profile);
  CHECK(area_of(Index(0x9FFF)) == Area::profile);
  CHECK(area_of(Index(0xA000)) == Area::other);
  CHECK(area_of(Index(0x0005)) == Area::other);
}

TEST_CASE("times, counts and what the process says are no difference") {
  CHECK(answers_between("collect heartbeat for 1 s", "4 frames, period 500 ms", "5 frames, period 499 ms") ==
        0);
  CHECK(answers_between("a frame of CAN-ID 181h within 1 s", "181h: 01 after 243 us",
                        "181h: 02 after 1 ms") == 0);
  CHECK(answers_between("EMCY within 1 s", "EMCY 1000h (generic error), error register 01h",
                        "EMCY 1000h (generic error), error register 11h") == 0);
  CHECK(answers_between("EMCY within 1 s", "EMCY 1000h (generic error), error register 01h",
                        "EMCY 8110h (overrun), error register 11h") == 1);
}

TEST_CASE("an entry that a run found otherwise before it wrote is told, in every area") {
  RunResult old = run_of({judged("a", "OD-1017-05", Verdict::pass)}), now = old;
  const auto held = [](RunResult& run, std::uint16_t index, std::vector<std::uint8_t> value, bool put_back) {
    run.changes.push_back({{Index(index), SubIndex(0)}, std::move(value), "a", put_back});
  };
  for (auto* run : {&old, &now}) {
    const std::uint8_t value = run == &old ? 0 : 1;
    held(*run, 0x1017, {value, 3}, true);
    held(*run, 0x2000, {value}, true);
    held(*run, 0x2001, {7}, true);
    held(*run, 0x2002, {value}, false);
    held(*run, 0x6200, {value}, true);
    held(*run, 0x1003, {value}, true);
  }
  held(old, 0x2010, {}, true);
  held(now, 0x2010, {5}, true);
  CHECK(entries_between(old, now) == Texts{"1017h:00: 00 03 -> 01 03", "2000h:00: 00 -> 01",
                                           "~2002h:00: 00 -> 01", "2010h:00: (no data) -> 05",
                                           "~6200h:00: 00 -> 01"});
}

TEST_CASE("fewer objects of a scenario are told, others of a sample are not") {
  const auto one = judged("a", "OD-1400-15", Verdict::pass, "1"),
             two = judged("a", "OD-1400-15", Verdict::pass, "2");
  CHECK(compare(run_of({one, two}), run_of({one})).instances.empty() == false);
  CHECK(compare(run_of({one}), run_of({two})).is_same());
}

TEST_CASE("identity is a difference of the device, seed and tool are circumstances") {
  RunResult old = run_of({judged("a", "OD-1017-05", Verdict::pass)}), now = old;
  old.tool = "canopen-conform 1";
  now.tool = "canopen-conform 2";
  old.properties = {{"run.seed", "1"}, {"dut.revision", "1"}};
  now.properties = {{"run.seed", "2"}, {"dut.revision", "1"}};
  auto comparison = compare(old, now);
  CHECK(comparison.is_same());
  CHECK(comparison.circumstances.size() == 2);
  now.properties[1].value = "2";
  comparison = compare(old, now);
  REQUIRE(comparison.identity.size() == 1);
  CHECK(comparison.identity[0].after == "2");
  CHECK(exit_code(comparison, true) == 0);
}
