// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "fixture.hpp"
#include "reports/compare.hpp"

using namespace conform;
using namespace conform::reports;
using namespace conform::reports::testing;

namespace {

const CompareOptions names{false, "old.json", "new.json"};

/// The sample run with every failure and warning turned into a pass.
result::RunResult mended(result::RunResult run) {
  for (auto& one : run.cases) {
    for (auto& judgement : one.judgements) {
      judgement.findings.clear();
      judgement.verdict = result::Verdict::pass;
    }
    one.verdict = result::Verdict::pass;
  }
  return run;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("what is new stands first, with the case that shows it") {
  const auto run = sample_run(), old = mended(run);
  const auto comparison = result::compare(old, run);
  const auto text = compare_text(comparison, names, {});
  REQUIRE_FALSE(comparison.new_causes.empty());
  const auto& first = comparison.new_causes.front().fresh.front();
  CHECK(holds(text, "New ("));
  CHECK(holds(text, first.finding->requirement));
  CHECK(holds(text, "\nworse: "));
  const auto markdown = compare_markdown(comparison, names);
  CHECK(markdown.starts_with("## worse: "));
  CHECK(holds(markdown, "- **fail** " + first.finding->requirement));
}

TEST_CASE("runs that are the same are said to be") {
  const auto run = mended(sample_run());
  const auto comparison = result::compare(run, run);
  CHECK(compare_text(comparison, names, {}).ends_with("\nno difference\n"));
  CHECK(compare_markdown(comparison, names).starts_with("## no difference\n"));
  CHECK(nlohmann::json::parse(compare_json(comparison, names)).at("same") == true);
}

TEST_CASE("the JSON has all that the comparison has") {
  const auto run = sample_run(), old = mended(run);
  const auto comparison = result::compare(old, run);
  const auto json = nlohmann::json::parse(compare_json(comparison, names));
  CHECK(json.at("canopen_conform_comparison") == comparison_version);
  CHECK(json.at("exit_code") == 1);
  CHECK(json.at("new_causes").size() == comparison.new_causes.size());
  CHECK(json.at("new_causes")[0].at("requirement") == comparison.new_causes[0].fresh[0].finding->requirement);
  CHECK(json.at("worse").size() == comparison.worse.size());
  CHECK(json.at("old") == "old.json");
}

TEST_CASE("nothing that a device says becomes a command of a terminal, a log or a page") {
  const auto run = hostile_run(hostile_text());
  auto old = mended(hostile_run("calm"));
  for (std::size_t i = 0; i < old.cases.size(); ++i) {
    old.cases[i].id = run.cases[i].id;
    old.cases[i].instance = run.cases[i].instance;
  }
  const auto comparison = result::compare(old, run);
  for (const auto& text :
       {compare_text(comparison, names, {}), compare_text(comparison, {false, hostile_text(), "x"}, {})}) {
    CHECK(std::ranges::none_of(text, [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7F; }));
    CHECK_FALSE(holds(text, "::error"));
    CHECK_FALSE(holds(text, "##["));
  }
  const auto markdown = compare_markdown(comparison, {false, hostile_text(), "x"});
  CHECK_FALSE(holds(markdown, "<script"));
  CHECK(std::ranges::none_of(markdown, [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7F; }));
  CHECK_NOTHROW(nlohmann::json::parse(compare_json(comparison, {false, hostile_text(), "x"})));
}

TEST_CASE("of two long values both are shown") {
  result::Comparison comparison;
  const std::string same(5000, '=');
  comparison.entries = {
      {{Index(0x1021), SubIndex(0)}, same + std::string(5000, 'A'), same + std::string(5000, 'B')}};
  const auto text = compare_text(comparison, names, {});
  CHECK(holds(text, "BBBB"));
  CHECK(holds(text, "AAAA"));
  CHECK(text.size() < 600);
  CHECK(holds(compare_json(comparison, names), same + std::string(5000, 'A')));
}

TEST_CASE("a difference of times says how sure it is") {
  result::Comparison comparison;
  result::TimesChange change;
  change.kind = "SDO answer";
  change.before = std::chrono::milliseconds(2);
  change.after = std::chrono::milliseconds(5);
  change.samples_before = change.samples_after = 200;
  change.p = 2e-40;
  change.longer = 0.97;
  comparison.times = {change};
  const auto text = compare_text(comparison, names, {});
  CHECK(holds(text, "SDO answer, all of them: median 5.0 ms, was 2.0 ms"));
  CHECK(holds(text, "longer in 97 % of all pairs; by chance: less than 1e-9 (200 and 200 samples)"));
  CHECK(holds(text, "\ndifferent, but not worse\n"));
}

TEST_CASE("requirements that turned alike stand in one line and are counted one by one") {
  result::Comparison comparison;
  for (const auto* id : {"SDO-UPL-01", "SDO-UPL-02", "SDO-UPL-03"}) {
    comparison.lost.emplace_back();
    comparison.lost.back().requirement = id;
    comparison.lost.back().before = result::Verdict::pass;
  }
  const auto text = compare_text(comparison, names, {});
  CHECK(holds(text, "No longer judged (3)"));
  CHECK(std::ranges::count(text.substr(text.find("No longer judged (3)")), '\n') < 6);
  CHECK(holds(compare_markdown(comparison, names), "No longer judged (3)"));
}
