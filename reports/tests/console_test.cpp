// SPDX-License-Identifier: Apache-2.0
#include "reports/console.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "catch.hpp"
#include "fixture.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"

using namespace conform;
using namespace conform::reports;
using result::RunResult;
using result::Verdict;

namespace {

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

std::string without_colours(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\x1B') {
      i = text.find('m', i);
      continue;
    }
    out += text[i];
  }
  return out;
}

}  // namespace

TEST_CASE("A passing case is one line with its requirements and its time") {
  const RunResult run = testing::sample_run();
  CHECK(case_line(run.cases[0], {}) ==
        "pass     cia301/dictionary/1000-device-type/readable  OD-1000-01  2.4 ms");
}

TEST_CASE("A case that did not pass says why on its line") {
  const RunResult run = testing::sample_run();
  CHECK(case_line(run.cases[1], {}) ==
        "fail     cia301/dictionary/1003-error-history/non-zero-write[02h]  OD-1003-06, OD-1003-07  12 ms  "
        "OD-1003-06: download 1003h:00 = 02h -> confirmed, expected abort 0609 0030h (invalid value)");
  CHECK(case_line(run.cases[4], {}) ==
        "inconcl  cia301/nmt/error-control/heartbeat-period[100 ms]  EC-HB-01, EC-HB-02  3.0 ms  "
        "set-up: download 1017h:00 = 100 -> abort 0800 0022h (device state), expected ok");
  CHECK(case_line(run.cases[5], {}) == "n/a      cia301/pdo/mapping/too-long[1A00h]  PDO-MAP-04  "
                                       "object 1A00h is present: no, it is not in the EDS and was not found");
  CHECK(case_line(run.cases[6], {}) == "error    cia301/pdo/mapping/order  PDO-MAP-05  not run");
}

TEST_CASE("Colours add nothing but escape sequences") {
  const RunResult run = testing::sample_run();
  const Style plain{false, 100, 0};
  const Style colour{true, 100, 0};
  CHECK(contains(summary(run, colour), "\x1B[1;31mFAIL:\x1B[0m"));
  CHECK(without_colours(summary(run, colour)) == summary(run, plain));
  for (const auto& one : run.cases) CHECK(without_colours(case_line(one, colour)) == case_line(one, plain));
}

TEST_CASE("The summary keeps to the width and has no blanks at line ends") {
  const RunResult run = testing::sample_run();
  for (const std::size_t width : {60U, 80U, 100U, 140U}) {
    const std::string text = summary(run, {false, width, 0});
    for (const std::string_view line : split(text, '\n')) {
      INFO(line);
      // The counts of the result and the table are not wrapped, whatever the width.
      CHECK(columns(line) <= std::max<std::size_t>(width, 82));
      CHECK_FALSE(line.ends_with(' '));
    }
  }
}

TEST_CASE("A card marks the decisive frame and stamps relative to the case") {
  const RunResult run = testing::sample_run();
  const auto& one = run.cases[1];
  const std::string card = finding_card(run, one, one.judgements[0].findings[0], {});
  CHECK(contains(card, "\n =>     2.840 < 583h  60 03 10 00 00 00 00 00  SDO download 1003h:00 confirmed\n"));
  CHECK(contains(card, "\n  |     1.600 > 603h  2F 03 10 00 02 00 00 00  SDO download 1003h:00 = 02h\n"));
  CHECK(contains(card, "  --> cia301/dictionary/1003-error-history.yaml:14:19\n"));
  CHECK(contains(
      card,
      "  | tolerated    abort 0609 0031h (value too high)\n  |              abort 0800 0000h (general error)\n"));
}

TEST_CASE("A long conversation is shown around its decisive frame") {
  RunResult run = testing::sample_run();
  auto& finding = run.cases[1].judgements[0].findings[0];
  const auto ordinary = finding.evidence[0];
  finding.evidence.insert(finding.evidence.begin(), 50, ordinary);
  finding.evidence.insert(finding.evidence.end(), 50, ordinary);
  const std::string card = finding_card(run, run.cases[1], finding, {});
  CHECK(contains(card, "... 43 frames before\n"));
  CHECK(contains(card, "... 47 frames after\n"));
}

TEST_CASE("A card of a silence ends with how long nothing came, behind what was to be answered") {
  RunResult run = testing::sample_run();
  auto& one = run.cases[1];
  auto& finding = one.judgements[0].findings[0];
  for (auto& frame : finding.evidence) frame.decisive = false;
  const auto asked = finding.evidence[1];
  finding.evidence.insert(finding.evidence.end(), 50, finding.evidence.back());
  finding.listened = result::Listening{asked.time, asked.time + std::chrono::milliseconds(500)};
  const auto from = milliseconds(asked.time - one.begin);
  const auto until = milliseconds(asked.time + std::chrono::milliseconds(500) - one.begin);
  const std::string card = finding_card(run, one, finding, {});
  CHECK(contains(card, until + "   nothing came that was waited for (500 ms since " + from + ")\n"));
  CHECK(contains(card, asked.meaning));
  CHECK(contains(card, " frames after\n"));
  // What was decided by a frame, and waited no longer, is no silence.
  finding.evidence.resize(2);
  finding.evidence.back().decisive = true;
  finding.listened->until = asked.time;
  CHECK_FALSE(contains(finding_card(run, one, finding, {}), "waited for"));
  // A period behind the last of several frames is none either, three of them are.
  finding.evidence = {asked, asked};
  finding.evidence.back().time += std::chrono::milliseconds(100);
  finding.evidence.back().decisive = true;
  finding.listened->until = finding.evidence.back().time + std::chrono::milliseconds(100);
  CHECK_FALSE(contains(finding_card(run, one, finding, {}), "no more came"));
  finding.listened->until += std::chrono::milliseconds(200);
  CHECK(contains(finding_card(run, one, finding, {}), "no more came of it (300 ms since "));
}

TEST_CASE("A violated recommendation is a warning although its finding failed") {
  RunResult run = testing::sample_run();
  run.cases[1].judgements[0].verdict = Verdict::warn;
  run.cases[1].verdict = Verdict::warn;
  const std::string text = summary(run, {});
  CHECK(contains(text, "Warnings: 1 cause"));
  CHECK(contains(text, "1. OD-1003-06: Pre-defined error field (1003h), 2 cases;"));
  CHECK(contains(text, "warn: OD-1003-06"));
  CHECK(contains(
      text,
      "also broken, of the same cause as far as can be told from outside:\n    OD-1003-08 (warn, 1 case)"));
}

TEST_CASE("Set-up steps that failed are shown even in a case that failed") {
  RunResult run = testing::sample_run();
  run.cases = {run.cases[1], run.cases[0]};
  run.cases[0].setup_findings = testing::sample_run().cases[4].setup_findings;
  const std::string text = summary(run, {});
  CHECK(contains(text, "Steps that could not be done"));
  CHECK(contains(text, "inconclusive: set-up: download 1017h:00 = 100"));
}

TEST_CASE("The number of cards can be limited") {
  const std::string text = summary(testing::sample_run(), {false, 100, 1});
  CHECK(contains(text, "FAIL: OD-1003-06"));
  CHECK_FALSE(contains(text, "FAIL: EC-HB-09"));
  CHECK(contains(text, "... and 1 more, in full in the report files"));
}

TEST_CASE("The last line gives the exit code and its meaning") {
  RunResult run = testing::sample_run();
  CHECK(summary(run, {}).ends_with("\nexit code     1: the device violates at least one requirement\n"));
  run.cases.resize(1);
  CHECK(summary(run, {}).ends_with("\nexit code     0: everything that was judged conforms\n"));
  run.cases.front().verdict = Verdict::not_applicable;
  CHECK(summary(run, {}).ends_with(
      "\nexit code     2: nothing selected applies to this device, so nothing was judged\n"));
  run.cases.front().wants = {{"option", std::string(result::longer_budget)}};
  CHECK(summary(run, {}).ends_with(
      "\nexit code     2: nothing that was selected fits into the --budget, so nothing was judged\n"));
  run.signal = 2;
  CHECK(summary(run, {}).ends_with("\nexit code     130: interrupted (SIGINT)\n"));
  CHECK(contains(summary(testing::aborted_run(), {}), "exit code     3: the run stopped early"));
}

TEST_CASE("Cases that were not run are one item with the cause") {
  const std::string text = summary(testing::aborted_run(), {});
  CHECK(contains(text, "- error: not run, nothing was ever heard from node 05h on can0\n"));
  CHECK(contains(text, "Not judged (2 cases)"));
}

TEST_CASE("A hostile device cannot steer the terminal or the CI system") {
  const RunResult run = testing::hostile_run(testing::hostile_text());
  std::string text = summary(run, {}) + progress(1, 2, "", testing::hostile_text(), {}, {});
  for (const auto& one : run.cases) text += case_line(one, {});
  CHECK(std::ranges::none_of(text, [](char c) { return (c >= 0 && c < 0x20 && c != '\n') || c == 0x7F; }));
  CHECK_FALSE(contains(text, "\u202E"));
  CHECK_FALSE(contains(text, "##vso["));
  CHECK_FALSE(contains(text, "::error"));
}

TEST_CASE("Progress is one line that never exceeds the width") {
  const RunResult run = testing::sample_run();
  CHECK(progress(37, 412, "", "cia301/sdo/upload", {}, {}) == "[ 37/412]  cia301/sdo/upload");
  CHECK(progress(37, 412, "", run.cases[1].name(), run.counts(), {false, 60, 0}) ==
        "[ 37/412]  2 fail  1 error  1 inconcl  1 warn  ...write[02h]");
  for (std::size_t width = 1; width < 120; ++width) {
    const std::string line = progress(37, 412, "", run.cases[1].name(), run.counts(), {true, width, 0});
    CHECK(columns(without_colours(line)) <= width);
  }
}

TEST_CASE("A cause says in a line which known mistakes it looks like") {
  RunResult run = testing::sample_run();
  CHECK(contains(
      summary(run, {.colour = false, .width = 200}),
      "  looks like 1003-nonzero-write-accepted of the reference node: 1003h:00 confirms any value, but keeps the "
      "history; or like 1003-nonzero-write-wrong-abort: 1003h:00"));
  CHECK_FALSE(contains(summary(run, {}), "run.command"));
  run.likenesses[0].name = "a\x1B[31m";
  CHECK_FALSE(contains(summary(run, {}), "\x1B"));
  run.likenesses.clear();
  CHECK_FALSE(contains(summary(run, {}), "looks like"));
}

TEST_CASE("What no grade names fails, and warns where the rule is not mandatory") {
  RunResult run = testing::sample_run();
  result::Finding finding = run.cases[1].judgements[0].findings[0];
  CHECK(otherwise_of(run, finding).label == "fails");
  for (auto& each : run.requirements) each.level = "recommended";
  finding.verdict = result::Verdict::warn;
  CHECK(otherwise_of(run, finding).label == "warns");
  // In a strict run it has failed all the same.
  finding.verdict = result::Verdict::fail;
  CHECK(otherwise_of(run, finding).label == "fails");
  finding.requirement.clear();
  CHECK(otherwise_of(run, finding).label == "otherwise");
}
