// SPDX-License-Identifier: Apache-2.0
// What the loader makes of a file that has no mistakes, the catalogue with its aliases, and which scenarios a
// run takes.
#include "scenario/loader.hpp"

#include "catch.hpp"
#include "scenario/files.hpp"
#include "scenario/selection.hpp"

namespace {

using namespace conform;
using namespace conform::scenario;

const std::string corpus = CONFORM_SOURCE_DIR "/harness/scenario/tests/corpus";

Catalogue catalogue() {
  std::vector<std::string> problems;
  auto out = Catalogue::load(corpus, problems);
  REQUIRE(out);
  REQUIRE(problems.empty());
  return std::move(*out);
}

ScenarioFile load(const std::string& name) {
  const auto known = catalogue();
  auto suite = load_suite(corpus, {name}, known);
  REQUIRE(suite);
  REQUIRE(suite->errors == 0);
  REQUIRE(suite->files.size() == 1);
  return std::move(suite->files.front());
}

TEST_CASE("The catalogue finds a requirement by its id and by an alias") {
  const auto known = catalogue();
  REQUIRE(known.all().size() == 2);
  REQUIRE(known.find("RULE-01") != nullptr);
  CHECK(known.find("OTHER-01") == known.find("RULE-01"));
  CHECK(known.canonical("OTHER-01") == "RULE-01");
  CHECK_FALSE(known.canonical("RULE-03"));
  CHECK(known.ids() == std::vector<std::string_view>{"OTHER-01", "RULE-01", "RULE-02"});
  const auto info = known.find("RULE-02")->info();
  CHECK(info.level == "recommended");
  CHECK(info.area == "Corpus");
  CHECK(known.find("RULE-01")->file == "suites/requirements/rules.yaml");
  CHECK(known.find("RULE-01")->line == 5);
}

TEST_CASE("A catalogue without its folder is an error that names the folder") {
  std::vector<std::string> problems;
  const auto out = Catalogue::load("/no/such/folder", problems);
  REQUIRE_FALSE(out);
  CHECK(out.error().where.find("/no/such/folder") != std::string::npos);
}

TEST_CASE("Scenario files are all YAML files outside of the reserved folders, sorted") {
  const auto files = scenario_files(corpus);
  REQUIRE(files);
  CHECK(std::ranges::is_sorted(*files));
  CHECK(std::ranges::find(*files, "good/smallest.yaml") != files->end());
  CHECK(std::ranges::find(*files, "requirements/rules.yaml") == files->end());
}

TEST_CASE("The path of the file and the id of the scenario make the name that everyone quotes") {
  const auto file = load("good/smallest.yaml");
  CHECK(file.title == "Smallest");
  REQUIRE(file.scenarios.size() == 1);
  const auto& only = file.scenarios.front();
  CHECK(only.id == "good/smallest/type");
  CHECK(only.suite == "good/smallest");
  CHECK(only.position.line == 5);
  CHECK(only.risk == Risk::read_only);
  CHECK(only.requirements == std::vector<std::string>{"RULE-01"});
}

TEST_CASE("Every key of a scenario arrives in the model") {
  const auto file = load("good/every-scenario-key.yaml");
  REQUIRE(file.scenarios.size() == 3);
  const auto& first = file.scenarios[0];
  CHECK(first.cct == std::vector<std::string>{"2.10", "2.11"});
  REQUIRE(first.given.size() == 1);
  CHECK(first.given.front().name == "long");
  REQUIRE(first.when);
  CHECK(first.when->may_write());
  CHECK(first.risk == Risk::nvm);
  CHECK(first.fresh == Fresh::node);
  CHECK(first.steps.size() == 2);
  CHECK(first.cleanup.size() == 1);
  REQUIRE(first.for_each);
  REQUIRE(first.for_each->rows.size() == 2);
  CHECK(first.for_each->rows[1].name == "second");
  CHECK(first.for_each->rows[1].texts.at("value") == "current");
  // The default check, the ids of the rows; the alias under its canonical name.
  CHECK(first.requirements == std::vector<std::string>{"RULE-01", "RULE-02"});
  const auto& query = file.scenarios[1];
  REQUIRE(query.for_each);
  CHECK(query.for_each->query == "entries with access ro or const and not domain");
  CHECK(query.for_each->variable == "entry");
  CHECK(query.sample == 64);
  CHECK(file.scenarios[2].for_each->rows.size() == 4);
}

TEST_CASE("Tiers of risk are words and back") {
  for (const auto risk : {Risk::read_only, Risk::config, Risk::nvm, Risk::motion})
    CHECK(steps::parse_tier(steps::word_of(risk)) == risk);
  CHECK_FALSE(steps::parse_tier("harmless"));
}

TEST_CASE("A pattern takes whole ids, leading paths and file names") {
  const std::string id = "cia301/dictionary/1003-error-history/non-zero-write[02h]";
  CHECK(matches_pattern(id, id));
  CHECK(matches_pattern("cia301", id));
  CHECK(matches_pattern("cia301/", id));
  CHECK(matches_pattern("cia301/dictionary/1003-error-history.yaml", id));
  CHECK(matches_pattern("cia301/dictionary/1003-error-history/non-zero-write", id));
  CHECK(matches_pattern("*/non-zero-write", id));
  CHECK(matches_pattern("cia301/*/1003*", id));
  CHECK(matches_pattern("*[0?h]", id));
  CHECK_FALSE(matches_pattern("cia30", id));
  CHECK_FALSE(matches_pattern("dictionary", id));
  CHECK_FALSE(matches_pattern("cia301/dictionary/1003-error-history/non-zero", id));
  CHECK_FALSE(matches_pattern("", id));
}

TEST_CASE("A hostile pattern ends as quickly as a short one") {
  const std::string id(5'000, 'a');
  std::string pattern;
  for (int i = 0; i < 2'000; ++i) pattern += "*a";
  CHECK(matches_pattern(pattern, id));
  CHECK_FALSE(matches_pattern(pattern + "*b", id));
  CHECK_FALSE(matches_pattern(std::string(5'001, '?'), id));
  CHECK(matches_pattern(std::string(100'000, '*'), id));
}

TEST_CASE("A selection joins patterns, requirements and exclusions") {
  const auto known = catalogue();
  Scenario one;
  one.id = "cia301/nmt/states/stop";
  one.requirements = {"RULE-01"};
  const auto takes = [&](Selection selection, std::string_view instance = "") {
    return selection.takes(one, instance, known);
  };
  CHECK(takes({}));
  CHECK(takes({{"cia301/nmt"}, {}, {}}));
  CHECK(takes({{"cia301/sdo", "*/stop"}, {}, {}}));
  CHECK_FALSE(takes({{"cia301/sdo"}, {}, {}}));
  CHECK(takes({{}, {"RULE-01"}, {}}));
  CHECK(takes({{}, {"OTHER-01"}, {}}));
  CHECK(takes({{}, {"RULE-*"}, {}}));
  CHECK_FALSE(takes({{}, {"RULE-02"}, {}}));
  CHECK_FALSE(takes({{}, {"RULE"}, {}}));
  CHECK_FALSE(takes({{}, {}, {"cia301/nmt"}}));
  CHECK(takes({{}, {}, {"*[02h]"}}, "01h"));
  CHECK_FALSE(takes({{}, {}, {"*[02h]"}}, "02h"));
  CHECK(Selection{{}, {"RULE-*"}, {}}.takes_any_of(one, known));
  CHECK_FALSE(Selection{{}, {"RULE-02"}, {}}.takes_any_of(one, known));
}

}  // namespace
