// SPDX-License-Identifier: Apache-2.0
// What CI systems, spreadsheets and pages of projects read.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <pugixml.hpp>

#include "base/text.hpp"
#include "catch.hpp"
#include "fixture.hpp"
#include "reports/annotations.hpp"
#include "reports/badge.hpp"
#include "reports/requirements_csv.hpp"
#include "reports/tap.hpp"

using namespace conform;
using namespace conform::reports;
using result::Verdict;

namespace {

bool contains(std::string_view text, std::string_view part) {
  INFO(text);
  return text.find(part) != std::string_view::npos;
}

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t out = 0;
  for (auto at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) ++out;
  return out;
}

/// One requirement in one case.
result::RunResult small_run(Verdict verdict) {
  result::RunResult run;
  auto& one = run.cases.emplace_back();
  one.id = "a";
  one.suite = "s";
  one.finished = true;
  one.verdict = verdict;
  one.requirements = {"R-1"};
  auto& judgement = one.judgements.emplace_back();
  judgement.requirement = "R-1";
  judgement.verdict = verdict;
  return run;
}

}  // namespace

TEST_CASE("The table of requirements has a row for each, and no cell that a spreadsheet would run") {
  const auto text = requirements_csv(testing::sample_run());
  CHECK(text.starts_with("requirement,level,clause,area,verdict,cases,case,decided by,waived\r\n"));
  CHECK(count(text, "\r\n") == testing::sample_run().requirements.size() + 1);
  auto run = small_run(Verdict::pass);
  run.requirements = {
      {.id = "R-1", .clause = "=cmd|' /C calc'!A1", .level = "+1", .area = "a, \"b\"", .statement = {}}};
  CHECK(contains(requirements_csv(run), "R-1,'+1,'=cmd|' /C calc'!A1,\"a, \"\"b\"\"\",pass,1,a,"));
}

TEST_CASE("TAP has a line for each case, and its directives cannot be forged") {
  const auto run = testing::sample_run();
  const auto text = tap(run);
  CHECK(text.starts_with(fmt::format("TAP version 13\n1..{}\n", run.cases.size())));
  CHECK(count(text, "\nok ") + count(text, "\nnot ok ") == run.cases.size());
  CHECK(contains(text, " # SKIP "));
  CHECK(contains(text, "  verdict: fail\n"));
  auto forged = small_run(Verdict::fail);
  forged.cases[0].id = "a # SKIP b\nok 2";
  CHECK(contains(tap(forged), "not ok 1 - a \\# SKIP b"));
  CHECK(count(tap(forged), "\nok ") == 0);
  auto waived = small_run(Verdict::waived);
  waived.cases[0].judgements[0].waived = "later";
  CHECK(contains(tap(waived), "not ok 1 - a # todo waived: later\n"));
  CHECK(contains(tap(testing::aborted_run()), "\nBail out! "));
}

TEST_CASE("The badge tells what passed of what was judged") {
  CHECK(contains(badge(small_run(Verdict::pass)), ">1/1</text>"));
  CHECK(contains(badge(small_run(Verdict::fail)), ">0/1</text>"));
  CHECK(contains(badge(small_run(Verdict::waived)), ">0/1 +1 waived</text>"));
  CHECK(contains(badge(small_run(Verdict::inconclusive)), ">not judged</text>"));
  pugi::xml_document document;
  CHECK(document.load_string(badge(testing::sample_run()).c_str()));
}

TEST_CASE("The code quality report has an issue for each cause, with a fingerprint that stays") {
  const auto run = testing::sample_run();
  const auto issues = nlohmann::json::parse(code_quality(run));
  REQUIRE_FALSE(issues.empty());
  for (const auto& issue : issues) {
    CHECK(issue.at("fingerprint").get<std::string>().size() == 16);
    CHECK_FALSE(issue.at("location").at("path").get<std::string>().empty());
    CHECK(issue.at("location").at("lines").at("begin").get<int>() >= 1);
  }
  auto later = run;
  for (auto& one : later.cases) one.begin += std::chrono::seconds(5);
  CHECK(nlohmann::json::parse(code_quality(later)) == issues);
  CHECK(nlohmann::json::parse(code_quality(small_run(Verdict::pass))).empty());
}

TEST_CASE("A cause about what the description claims points at its line") {
  auto run = small_run(Verdict::fail);
  auto& finding = run.cases[0].judgements[0].findings.emplace_back();
  finding.requirement = "R-1";
  finding.step = "upload 1000h:00";
  finding.actual = "100%";
  finding.position = {"suites/a.yaml", 7, 3};
  CHECK(github_annotations(run) ==
        "::error file=suites/a.yaml,line=7,title=R-1::R-1: upload 1000h:00 -> 100%25 (1 case)\n");
  finding.declared_at = "device.eds:120";
  CHECK(contains(github_annotations(run), "file=device.eds,line=120,"));
  finding.declared_at = "device.eds, without 2001h:00";
  CHECK(contains(github_annotations(run), "file=suites/a.yaml,line=7,"));
}

TEST_CASE("Nothing that a device says makes a CI system obey a line") {
  const auto run = testing::hostile_run(testing::hostile_text());
  for (const auto& text : {github_annotations(run), tap(run), requirements_csv(run)}) {
    for (const auto line : split(text, '\n')) {
      const bool own = line.starts_with("::error file=") || line.starts_with("::warning file=");
      CHECK((own || (!line.starts_with("::") && !line.starts_with("##"))));
      for (const char c : line) CHECK((static_cast<std::uint8_t>(c) >= 0x20 || c == '\r'));
    }
  }
  CHECK_NOTHROW(nlohmann::json::parse(code_quality(run)));
}
