// SPDX-License-Identifier: Apache-2.0
#include "cli/usage/known_values.hpp"

#include <algorithm>
#include <string>

#include <CLI/CLI.hpp>

#include "catch.hpp"
#include "cli/suite_folder.hpp"

using namespace conform;

namespace {

/// The words for an option of this name and type.
std::vector<usage::Candidate> values(const std::string& option, const char* type,
                                     const std::string& command = "run") {
  CLI::App app;
  auto* sub = app.add_subcommand(command, "");
  std::string into;
  auto* added = sub->add_option(option, into, "")->type_name(type);
  const auto root = std::string(CONFORM_SOURCE_DIR) + "/suites";
  const auto found = cli::known_values({.command = sub, .option = added, .given = {{"--suites", {root}}}});
  return found ? *found : std::vector<usage::Candidate>{};
}

bool has(const std::vector<usage::Candidate>& all, const std::string& word) {
  return std::ranges::find(all, word, &usage::Candidate::word) != all.end();
}

}  // namespace

TEST_CASE("ids are found in files by their lines") {
  const auto found = cli::ids_in(
      "format: 1\nscenarios:\n  - id: one\n    title: The first\n    steps:\n      - id: no scenario\n"
      "  - id: \"two\"\n    title: >-\n      folded\n  - title: Without\n",
      "a/b/");
  REQUIRE(found.size() == 2);
  CHECK(found[0].word == "a/b/one");
  CHECK(found[0].about == "The first");
  CHECK(found[1].word == "a/b/two");
  CHECK(found[1].about.empty());
  CHECK(cli::ids_in("", "").empty());
}

TEST_CASE("all scenarios and requirements of the suites are completed") {
  const auto folders =
      cli::find_suites(std::vector<std::string>{std::string(CONFORM_SOURCE_DIR) + "/suites"});
  REQUIRE(folders);
  const auto suites = cli::load_suites(*folders, false);
  REQUIRE(suites);
  const auto requirements = values("-r,--requirement", "ID");
  CHECK(requirements.size() == suites->catalogue.all().size());
  for (const auto& each : suites->catalogue.all()) CHECK(has(requirements, each.id));
  const auto cases = values("select", "ID");
  for (const auto& file : suites->suite.files) {
    for (const auto& each : file.scenarios) CHECK(has(cases, each.id));
  }
  CHECK(has(cases, "monitor/sdo-toggle"));
}

TEST_CASE("what only the program knows is completed") {
  CHECK(has(values("--defect", "ID"), "1003-nonzero-write-accepted"));
  CHECK(has(values("--variant", "ID"), "1003-depth-1"));
  CHECK(has(values("--allow", "RISK"), "read-only"));
  CHECK(has(values("--allow", "RULE"), "EDS212"));
  CHECK(has(values("--severity", "RULE=SEVERITY"), "EDS212=note"));
  const auto topics = values("topic", "TOPIC", "explain");
  for (const auto* word : {"verbs", "download", "OD-1003-06", "EDS212", "monitor/sdo-toggle", "1003-depth-1"})
    CHECK(has(topics, word));
  const auto monitors = values("select", "ID", "judge");
  CHECK(has(monitors, "monitor/sdo-toggle"));
  CHECK_FALSE(has(monitors, "cia301/dictionary/1003-error-history/number-of-errors"));
}
