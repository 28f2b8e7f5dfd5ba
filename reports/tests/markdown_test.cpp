// SPDX-License-Identifier: Apache-2.0
#include "reports/markdown.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "catch.hpp"
#include "fixture.hpp"
#include "reports/markdown_parts.hpp"

using namespace conform;
using namespace conform::reports;
using result::RunResult;

namespace {
bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }
}  // namespace

TEST_CASE("The Markdown report with evidence gives verdict, table and evidence") {
  const std::string text = markdown_evidence(testing::sample_run());
  CHECK(text.starts_with("## Conforming drive: does not conform\n"));
  CHECK(contains(text, "| Pre-defined error field (1003h) | 1 | 1 | 1 |  |  |  |\n"));
  CHECK(contains(text, "### Failures (2)\n"));
  CHECK(contains(text, "**OD-1003-06**: download 1003h:00 = 02h -\\> confirmed, expected abort 0609 0030h"));
  CHECK(contains(text, " =>     2.840 < 583h"));
}

TEST_CASE("Strings of a device are neither markup nor mentions") {
  RunResult run = testing::sample_run();
  run.device = "# <img src=x> @everyone [a](http://x) | `b` **c** ~~~~~~\n## d";
  run.cases[1].judgements[0].findings[0].actual = "a\n~~~~~~\n</details><script>`";
  run.cases[4].instance = "``";
  const std::string text = markdown_evidence(run);
  CHECK(contains(text, "## \\# &lt;img src=x\\> &#64;everyone \\[a\\](http://x) \\| \\`b\\` \\*\\*c\\*\\*"));
  CHECK_FALSE(contains(text, "\n## d"));
  CHECK_FALSE(contains(text, "<img"));
  CHECK(contains(text, "```cia301/nmt/error-control/heartbeat-period[``]```"));
  for (const std::string_view line : split(text, '\n')) {
    if (line.starts_with("~~~~~~")) CHECK((line == "~~~~~~" || line == "~~~~~~text"));
  }
}

TEST_CASE("The Markdown report with evidence stays below its limit") {
  RunResult run = testing::sample_run();
  for (int i = 0; i < 200; ++i) run.cases.push_back(run.cases[1]);
  const std::string text = markdown_evidence(run, {}, {20'000});
  CHECK(text.size() < 20'500);
  const std::string cut = markdown_evidence(testing::sample_run(), {}, {4'000});
  CHECK(cut.size() < 4'500);
  CHECK(contains(cut, "more, see the other reports of this run"));
}

TEST_CASE("The Markdown report with evidence begins with the causes, one line each") {
  RunResult run = testing::sample_run();
  for (int i = 0; i < 200; ++i) run.cases.push_back(run.cases[1]);
  const std::string text = markdown_evidence(run);
  const auto list = text.find("| | Cause | Requirement | Cases | First case |");
  REQUIRE(list != std::string::npos);
  CHECK(list < text.find("| Requirements |"));
  CHECK(contains(text, "| OD-1003-06 | 202 |"));
}

TEST_CASE("The short Markdown report has at most 60 lines, whatever happened") {
  RunResult run = testing::sample_run();
  CHECK(std::ranges::count(markdown(run), '\n') <= 60);
  // More of everything than it shows.
  run.aborted = "the interface went down";
  for (int i = 0; i < 100; ++i) {
    result::RequirementInfo info = run.requirements.front();
    info.id = "R" + std::to_string(i) + "-01";
    info.area = "Area " + std::to_string(i);
    run.requirements.push_back(info);
    auto one = run.cases[1];
    one.id += std::to_string(i);
    for (auto& judgement : one.judgements) {
      judgement.requirement = info.id;
      for (auto& finding : judgement.findings) {
        finding.requirement = info.id;
        finding.actual += std::to_string(i);
      }
    }
    run.cases.push_back(one);
    run.notes.push_back("note " + std::to_string(i));
    result::WaiverUse waiver;
    waiver.requirement = info.id;
    run.waivers.push_back(waiver);
    run.compared.push_back({std::to_string(i), "SDO", "t", i % 2 == 0 ? "passed" : "failed", "", {}});
    auto wanting = run.cases[0];
    wanting.verdict = result::Verdict::not_applicable;
    wanting.wants.push_back({"object", "thing " + std::to_string(i)});
    run.cases.push_back(wanting);
  }
  const std::string text =
      markdown(run, {"/out/d/a.md", {{"html", "/out/d/b c.html"}, {"junit", "/x/other/j.xml"}}});
  INFO(text);
  CHECK(std::ranges::count(text, '\n') <= 60);
  CHECK(contains(markdown_causes(run, result::causes_of(run), 1), "\n... and "));
  CHECK(contains(text, "[html](b%20c.html), junit `/x/other/j.xml`"));
  CHECK(contains(text, "50 passed, 50 failed"));
}

TEST_CASE("The short Markdown report begins with the causes") {
  const std::string text = markdown(testing::sample_run());
  CHECK(text.starts_with("## Conforming drive: does not conform\n"));
  CHECK(text.find("| | Cause | Requirement | Cases | First case |") < text.find("| Requirements |"));
}

TEST_CASE("The Markdown report says which known mistake a cause looks like") {
  const std::string text = markdown_evidence(testing::sample_run());
  CHECK(
      contains(text, "\nIt looks like 1003-nonzero-write-accepted of the reference node: 1003h:00 confirms"));
  CHECK_FALSE(contains(text, "run.command"));
}

TEST_CASE("The Markdown report names the capture of a cause where the run has written one") {
  const RunResult run = testing::sample_run();
  CHECK_FALSE(contains(markdown_evidence(run), ".pcapng"));
  const Beside beside{.path = "/out/evidence.md", .captures = "/out/captures"};
  CHECK(contains(markdown_evidence(run, beside), "Frames for Wireshark: `captures/cause-01-"));
  CHECK(contains(markdown(run, beside), "[one capture per cause](captures)"));
  // Where nothing of it was seen on the bus, there is nothing to name.
  RunResult silent = run;
  for (auto& one : silent.cases) {
    one.end_frame = one.first_frame;
    for (auto& judgement : one.judgements) {
      for (auto& finding : judgement.findings) finding.evidence.clear();
    }
  }
  CHECK_FALSE(contains(markdown_evidence(silent, beside), ".pcapng"));
}
