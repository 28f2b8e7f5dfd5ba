// SPDX-License-Identifier: Apache-2.0
// Whom a run blames: that the table of what rests on what names rules that there are, and that runs against
// defects show one cause. All defects take minutes: `selftest --blame`.
#include "cli/blame.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "catch.hpp"
#include "cli/suite_folder.hpp"
#include "device/profile.hpp"
#include "result/relations.hpp"

using namespace conform;

namespace {

const std::string suites_folder = std::string(CONFORM_SOURCE_DIR) + "/suites";

const cli::LoadedSuites& suites() {
  static const auto loaded = [] {
    auto out = cli::load_suites(suites_folder, false);
    REQUIRE(out.has_value());
    return std::move(*out);
  }();
  return loaded;
}

/// Ids, or beginnings of ids, that no requirement has.
std::vector<std::string> unknown(std::string_view list) {
  std::vector<std::string> out;
  for (const auto pattern : result::words(list)) {
    const auto& all = suites().catalogue.all();
    const bool known = std::ranges::any_of(
        all, [&](const scenario::Requirement& each) { return result::fits(pattern, each.id); });
    if (!known) out.emplace_back(pattern);
  }
  return out;
}

}  // namespace

TEST_CASE("what rests on what is told of requirements that the catalogue has") {
  for (const auto& relation : result::grounds()) {
    CHECK(unknown(relation.rules).empty());
    CHECK(unknown(relation.grounds).empty());
  }
  for (const auto rules : result::kin()) CHECK(unknown(rules).empty());
  CHECK(unknown(result::grounds_of_any_answer()).empty());
  CHECK(unknown(result::grounds_of_any_silence()).empty());
  CHECK(unknown(result::grounds_of_any_abort()).empty());
}

TEST_CASE("no two rules rest on each other") {
  std::set<std::pair<std::string, std::string>> edges;
  const auto& all = suites().catalogue.all();
  for (const auto& relation : result::grounds()) {
    for (const auto& rule : all) {
      if (!result::is_in(relation.rules, rule.id)) continue;
      for (const auto& ground : all) {
        if (ground.id != rule.id && result::is_in(relation.grounds, ground.id))
          edges.emplace(rule.id, ground.id);
      }
    }
  }
  for (const auto& [rule, ground] : edges) {
    INFO(rule << " and " << ground);
    CHECK_FALSE(edges.contains({ground, rule}));
  }
}
