// SPDX-License-Identifier: Apache-2.0
#include "result/patterns.hpp"

#include <algorithm>

#include "catch.hpp"
#include "result/pattern_file.hpp"

using namespace conform;
using namespace conform::result;

namespace {

/// A run with one cause: rules of one part of a device, each broken in its way.
RunResult broken(std::initializer_list<std::pair<const char*, const char*>> signs) {
  RunResult out;
  CaseResult one;
  one.id = "case";
  one.verdict = Verdict::fail;
  for (const auto& [requirement, deviation] : signs) {
    Finding finding;
    finding.requirement = requirement;
    finding.deviation = deviation;
    finding.frames_seen = out.cases.size() + 1;
    one.judgements.push_back({requirement, Verdict::fail, {finding}});
  }
  out.cases.push_back(one);
  return out;
}

Pattern pattern(const std::string& name, std::initializer_list<std::pair<std::string, std::string>> signs) {
  return {name, "what " + name + " does wrong", {signs.begin()->first, {signs.begin(), signs.end()}, {}}};
}

std::vector<std::string> names(const RunResult& run, const std::vector<Pattern>& patterns) {
  std::vector<std::string> out;
  for (const auto& each : likenesses_of(run, patterns)) out.push_back(each.name);
  return out;
}

}  // namespace

TEST_CASE("a cause looks like the defect that breaks the same rules in the same way") {
  const auto run = broken({{"EC-HBP-02", "confirmed"}, {"EC-HBP-03", "no heartbeat"}});
  const std::vector patterns{
      pattern("other-lead", {{"EC-HBP-03", "no heartbeat"}, {"EC-HBP-02", "confirmed"}}),
      pattern("half", {{"EC-HBP-02", "confirmed"}, {"EC-HBP-03", "other"}}),
      pattern("same", {{"EC-HBP-02", "confirmed"}, {"EC-HBP-03", "no heartbeat"}})};
  const auto found = likenesses_of(run, patterns);
  REQUIRE(found.size() == 2);
  CHECK(found[0].name == "same");
  CHECK(found[0].summary == "what same does wrong");
  CHECK(found[0].percent == 100);
  CHECK(found[0].requirement == "EC-HBP-02");
  CHECK(found[0].case_name == "case");
  CHECK(found[1].name == "half");
  CHECK(found[1].percent == 67);  // both of two rules, one of three signs
}

TEST_CASE("what shares a rule with a defect and little else does not look like it") {
  const auto run = broken({{"EC-HBP-02", "confirmed"}});
  CHECK(
      names(run, {pattern("wider", {{"EC-HBP-02", "confirmed"}, {"EC-HBP-03", "a"}, {"EC-HBP-04", "a"}})}) ==
      std::vector<std::string>{"wider"});  // rules that the run could not judge do not count
  auto judged = run;
  judged.cases[0].judgements.push_back({"EC-HBP-03", Verdict::pass, {}});
  judged.cases[0].judgements.push_back({"EC-HBP-04", Verdict::pass, {}});
  CHECK(
      names(judged, {pattern("wider", {{"EC-HBP-02", "confirmed"}, {"EC-HBP-03", "a"}, {"EC-HBP-04", "a"}})})
          .empty());
  CHECK(names(run, {pattern("otherwise", {{"EC-HBP-02", "no answer"}})}).empty());
}

TEST_CASE("three names say something, and four that are equally alike say nothing") {
  const auto run = broken({{"EC-HBP-02", "confirmed"}});
  std::vector<Pattern> patterns;
  for (const auto* name : {"a", "b", "c"}) patterns.push_back(pattern(name, {{"EC-HBP-02", "confirmed"}}));
  CHECK(names(run, patterns) == std::vector<std::string>{"a", "b", "c"});
  patterns.push_back(pattern("d", {{"EC-HBP-02", "confirmed"}}));
  CHECK(names(run, patterns).empty());
}

TEST_CASE("of many that break the same rules alike those are named that the same cases show") {
  auto run = broken({{"EC-HBP-02", "confirmed"}});
  std::vector<Pattern> patterns;
  for (const auto* name : {"a", "b", "c", "d"}) {
    patterns.push_back(pattern(name, {{"EC-HBP-02", "confirmed"}}));
    patterns.back().footprint.cases = {"other"};
  }
  patterns[2].footprint.cases = {"case", "not played"};  // what this run could not judge does not count
  CHECK(names(run, patterns) == std::vector<std::string>{"c", "a", "b"});
  run.cases.emplace_back().id = "not played";
  run.cases.back().judgements.push_back({"EC-HBP-02", Verdict::pass, {}});
  patterns[3].footprint.cases = {"case"};
  CHECK(names(run, patterns) == std::vector<std::string>{"d", "c", "a"});
}

TEST_CASE("what shows in many cases is not told by their names") {
  Cause cause;
  CaseResult cases[few_cases + 1];
  Finding finding;
  cause.primary = {&cases[0], &finding};
  for (std::size_t i = 0; i < few_cases; ++i) {
    cases[i].id = "case " + std::to_string(i);
    cause.findings.push_back({&cases[i], &finding});
  }
  CHECK(footprint_of(cause).cases.size() == few_cases);
  cause.findings.push_back({&cases[few_cases], &finding});
  CHECK(footprint_of(cause).cases.empty());
}

TEST_CASE("a run without a cause looks like no defect, and one without a pattern like none") {
  RunResult passed;
  passed.cases.emplace_back();
  passed.cases[0].judgements.push_back({"EC-HBP-02", Verdict::pass, {}});
  CHECK(names(passed, {pattern("a", {{"EC-HBP-02", "confirmed"}})}).empty());
  CHECK(names(broken({{"EC-HBP-02", "confirmed"}}), {}).empty());
}

TEST_CASE("a file of patterns is read as it was written, a line for each") {
  std::vector patterns{pattern("a", {{"R-1", "no answer"}, {"R-2", "no answer"}, {"R-1", "confirmed"}}),
                       pattern("b \"quoted\"", {{"R-3", ""}})};
  patterns[1].footprint.cases = {"suite/case"};
  const auto text = pattern_file(patterns);
  const auto back = read_patterns(text, "file");
  REQUIRE(back);
  CHECK(*back == patterns);
  CHECK(std::ranges::count(text, '\n') == 5);
  CHECK(read_patterns(pattern_file({}), "file")->empty());
}

TEST_CASE("what is no file of patterns says so with the place") {
  const auto mistake = [](std::string_view text) {
    const auto read = read_patterns(text, "p.json");
    REQUIRE_FALSE(read);
    CHECK(read.error().where == "p.json");
    return read.error().what;
  };
  CHECK(mistake("{\n\"canopen_conform_patterns\":1,\n oops").find("line 3") != std::string::npos);
  CHECK(mistake("{}").starts_with("is no file of patterns"));
  CHECK(mistake(R"({"canopen_conform_patterns":2,"patterns":[]})").find("version") != std::string::npos);
  CHECK(mistake(R"({"canopen_conform_patterns":1,"patterns":[{"name":"a"}]})")
            .starts_with("pattern 1 is none"));
}
