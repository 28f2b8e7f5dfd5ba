// SPDX-License-Identifier: Apache-2.0
#include "reports/markdown.hpp"

#include "base/text.hpp"
#include "catch.hpp"
#include "fixture.hpp"
#include "result/cause_captures.hpp"

using namespace conform;
using namespace conform::reports;
using result::RunResult;

namespace {
bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }
}  // namespace

TEST_CASE("The Markdown report gives verdict, table and evidence") {
  const std::string text = markdown(testing::sample_run());
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
  const std::string text = markdown(run);
  CHECK(contains(text, "## \\# &lt;img src=x\\> &#64;everyone \\[a\\](http://x) \\| \\`b\\` \\*\\*c\\*\\*"));
  CHECK_FALSE(contains(text, "\n## d"));
  CHECK_FALSE(contains(text, "<img"));
  CHECK(contains(text, "```cia301/nmt/error-control/heartbeat-period[``]```"));
  for (const std::string_view line : split(text, '\n')) {
    if (line.starts_with("~~~~~~")) CHECK((line == "~~~~~~" || line == "~~~~~~text"));
  }
}

TEST_CASE("The Markdown report stays below its limit") {
  RunResult run = testing::sample_run();
  for (int i = 0; i < 200; ++i) run.cases.push_back(run.cases[1]);
  const std::string text = markdown(run, {20'000});
  CHECK(text.size() < 20'500);
  const std::string cut = markdown(testing::sample_run(), {4'000});
  CHECK(cut.size() < 4'500);
  CHECK(contains(cut, "more, see the other reports of this run"));
}

TEST_CASE("The Markdown report begins with the causes, one line each") {
  RunResult run = testing::sample_run();
  for (int i = 0; i < 200; ++i) run.cases.push_back(run.cases[1]);
  const std::string text = markdown(run);
  const auto list = text.find("| | Cause | Requirement | Cases | First case |");
  REQUIRE(list != std::string::npos);
  CHECK(list < text.find("| Requirements |"));
  CHECK(contains(text, "| OD-1003-06 | 202 |"));
}

TEST_CASE("The Markdown report names the capture of a cause where the run has written one") {
  RunResult run = testing::sample_run();
  CHECK_FALSE(contains(markdown(run), ".pcapng"));
  run.properties.push_back({std::string(result::captures_property), "captures"});
  CHECK(contains(markdown(run), "Frames for Wireshark: `captures/cause-01-"));
}
