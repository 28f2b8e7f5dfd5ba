// SPDX-License-Identifier: Apache-2.0
// What scenarios tolerate is written in the catalogue. Read from their files, as an author wrote them: a
// conversation keeps to itself which codes it tolerates.
#include <cstddef>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "scenario/scenario.hpp"
#include "shipped.hpp"
#include "steps/outcome.hpp"
#include "yaml/loader.hpp"

using namespace conform;
namespace shipped = cli::shipped;

namespace {

using Ids = std::vector<std::string>;

Ids checks_of(const yaml::Node& at, const Ids& otherwise) {
  const auto* checks = at.find("checks");
  if (checks == nullptr) return otherwise;
  if (checks->is_scalar()) return {checks->text()};
  Ids out;
  for (const auto& each : checks->items()) out.push_back(each.text());
  return out;
}

/// "{abort: 0503 0000h; warn any}" among the frames of a conversation.
bool tolerates_codes(const yaml::Node& at) {
  static const std::regex slot(R"(\{abort:[^}]*\bwarn )");
  const auto* talk = at.find("talk");
  const auto* frames = talk != nullptr && talk->is_mapping() ? talk->find("frames") : talk;
  return frames != nullptr && std::regex_search(frames->text(), slot);
}

bool warns(const yaml::Node& at) {
  const auto* verdict = at.find("verdict");
  return at.find("warn") != nullptr || (verdict != nullptr && verdict->text() == "warn") ||
         tolerates_codes(at);
}

/// The ids of all that can warn. Not what a reserved byte (zz) adds to a conversation: the rule about it is
/// SDO-GEN-05, which only recommends.
void add_warned(const yaml::Node& steps, const Ids& inherited, std::set<std::string>& out) {
  for (const auto& step : steps.items()) {
    const auto decided = checks_of(step, inherited);
    if (warns(step)) out.insert(decided.begin(), decided.end());
    if (const auto* inner = step.find("steps")) add_warned(*inner, inherited, out);
    const auto* either = step.find("either");
    if (either == nullptr) continue;
    for (const auto& branch : either->items()) {
      const auto own = checks_of(branch, decided);
      if (warns(branch)) out.insert(own.begin(), own.end());
      if (const auto* inner = branch.find("steps")) add_warned(*inner, inherited, out);
    }
  }
}

/// "$rule" is what the rows of the scenario say.
Ids names_of(const std::string& id, const scenario::Scenario& scenario) {
  if (!id.starts_with('$')) return {id};
  Ids out;
  REQUIRE(scenario.for_each);
  for (const auto& row : scenario.for_each->rows) out.push_back(row.texts.at(id.substr(1)));
  return out;
}

}  // namespace

TEST_CASE("a scenario warns only of what the catalogue says warns") {
  const auto& [catalogue, suite] = shipped::suites();
  std::set<std::string> unsaid;
  std::size_t said = 0;
  for (const auto& file : suite.files) {
    INFO(file.path);
    const auto document = yaml::load_file(shipped::folder + "/" + file.path);
    REQUIRE(document.has_value());
    REQUIRE(document->root.has_value());
    const auto& written = document->root->find("scenarios")->items();
    REQUIRE(written.size() == file.scenarios.size());
    for (std::size_t i = 0; i < written.size(); ++i) {
      std::set<std::string> warned;
      add_warned(*written[i].find("steps"), checks_of(written[i], {}), warned);
      for (const auto& id : warned) {
        for (const auto& name : names_of(id, file.scenarios[i])) {
          const auto* requirement = catalogue.find(name);
          REQUIRE(requirement != nullptr);
          if (!requirement->warns.empty()) {
            ++said;
          } else if (steps::is_binding(requirement->level)) {
            unsaid.insert(name + " in " + file.scenarios[i].id);
          }
        }
      }
    }
  }
  CHECK(said > 100);
  CHECK(unsaid == std::set<std::string>{});
}
