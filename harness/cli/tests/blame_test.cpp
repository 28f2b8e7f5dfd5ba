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
#include "result/patterns.hpp"
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

const std::vector<result::Pattern>& patterns() {
  static const auto loaded = [] {
    auto out = cli::load_patterns(cli::shipped::folder);
    REQUIRE(out.has_value());
    return std::move(*out);
  }();
  return loaded;
}

constexpr const char* how_to_make =
    "canopen-conform selftest --patterns suites/patterns/reference-node.json makes it anew";

const cli::KillMatrix& sample() {
  static const auto computed = [] {
    // Every 17th: from each table, and quick enough for CTest.
    constexpr std::size_t stride = 17;
    cli::KillOptions options;
    options.blame = true;
    options.pairs = 40;
    options.known = patterns();
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

TEST_CASE("the file of patterns knows every defect, and no other") {
  INFO(how_to_make);
  std::set<std::string_view> known;
  for (const auto& pattern : patterns()) {
    INFO(pattern.name);
    const auto* defect = refnode::find_defect(pattern.name);
    REQUIRE(defect != nullptr);
    CHECK(pattern.summary == defect->summary);
    CHECK(known.insert(defect->id).second);
  }
  // Those that show in no run of the whole suite have none.
  const auto all = refnode::defects().size();
  CHECK(known.size() + 2 >= all);
}

TEST_CASE("the patterns in the tree are those of these defects and these suites") {
  for (const auto& blame : sample().blames) {
    INFO(blame.defect << ": " << how_to_make);
    const auto found = std::ranges::find(patterns(), blame.defect, &result::Pattern::name);
    CHECK((blame.pattern.footprint.lead.empty() ? found == patterns().end()
                                                : found != patterns().end() && *found == blame.pattern));
  }
}

TEST_CASE("a defect is among the names at its cause, and a right device gets none") {
  // Faults that look the same are not told apart, and the finer they become the more of them do.
  constexpr double least_named = 0.88;
  result::Judged judged;
  for (const auto& requirement : suites().catalogue.all()) judged.requirements.insert(requirement.id);
  for (const auto& pattern : patterns())
    judged.cases.insert(pattern.footprint.cases.begin(), pattern.footprint.cases.end());
  std::size_t named = 0;
  std::string others;
  for (const auto& pattern : patterns()) {
    const auto alike = result::alike_to(pattern.footprint, patterns(), judged);
    CHECK(alike.size() <= result::most_alike);
    const bool hit = std::ranges::any_of(
        alike, [&](const result::Alike& each) { return each.pattern->name == pattern.name; });
    named += hit ? 1U : 0U;
    if (!hit) others += pattern.name + " ";
  }
  INFO("not named: " << others);
  CHECK(static_cast<double>(named) >= least_named * static_cast<double>(patterns().size()));
  CHECK(result::likenesses_of(sample().conformant, patterns()).empty());
}

TEST_CASE("a defect is named in a run with another seed, too") {
  // Other samples of objects and values are drawn, and the causes are seen in other cases.
  constexpr std::size_t stride = 41;
  constexpr double least_named = 0.7;
  constexpr std::uint64_t seed = 2;
  const auto all = refnode::defects();
  std::size_t named = 0, runs = 0;
  std::string others;
  for (std::size_t i = 5; i < all.size(); i += stride, ++runs) {
    engine::RunOptions options;
    options.plan.slow = false;
    const auto run = cli::simulate({.defects = {std::string(all[i].id)}}, cli::shipped::reference(),
                                   suites().suite, suites().catalogue, options, seed);
    REQUIRE(run.has_value());
    const auto found = result::likenesses_of(run->result, patterns());
    const bool hit = std::ranges::any_of(found, [&](const auto& each) { return each.name == all[i].id; });
    named += hit ? 1U : 0U;
    if (!hit) others += std::string(all[i].id) + " ";
  }
  INFO("not named: " << others);
  CHECK(static_cast<double>(named) >= least_named * static_cast<double>(runs));
}
