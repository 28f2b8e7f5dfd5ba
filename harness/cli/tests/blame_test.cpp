// SPDX-License-Identifier: Apache-2.0
// Whom a run blames: that the table of what rests on what names rules that there are, and that runs against
// defects show one cause. All defects take minutes: `selftest --blame`.
#include "cli/proof/blame.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/text.hpp"
#include "catch.hpp"
#include "defects/defect.hpp"
#include "result/relations.hpp"
#include "shipped.hpp"

using namespace conform;
using cli::shipped::suites;

namespace {

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

const cli::KillMatrix& sample() {
  static const auto computed = [] {
    // Every 17th: from each table, and quick enough for CTest.
    constexpr std::size_t stride = 17;
    cli::KillOptions options;
    options.blame = true;
    options.pairs = 40;
    const auto all = refnode::defects();
    for (std::size_t i = 3; i < all.size(); i += stride) options.only.emplace_back(all[i].id);
    auto out = cli::kill_matrix(cli::shipped::reference(), suites().suite, suites().catalogue, options);
    REQUIRE(out.has_value());
    return std::move(*out);
  }();
  return computed;
}

}  // namespace

TEST_CASE("one fault is one cause, told by a rule that it breaks") {
  for (const auto& blame : sample().blames) {
    INFO(blame.defect << ": " << join(blame.about, "; "));
    CHECK((blame.single_and_right() || cli::reason_of_blame(blame.defect)));
  }
}

TEST_CASE("two faults of different parts are two causes, but where one takes the other's ground") {
  const auto& pairs = sample().pairs;
  REQUIRE(pairs.size() >= 30);
  // An SDO server that answers with another object leaves nothing to say about entries.
  std::string swallowed;
  for (const auto& pair : pairs) {
    if (pair.swallowed)
      swallowed += pair.first + " and " + pair.second + ": " + join(pair.about, "; ") + "\n";
  }
  INFO(swallowed);
  CHECK(10 * std::ranges::count_if(pairs, &cli::PairBlame::swallowed) <= std::ssize(pairs));
}

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
