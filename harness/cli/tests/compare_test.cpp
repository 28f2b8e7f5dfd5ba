// SPDX-License-Identifier: Apache-2.0
// Comparisons of whole runs: a defect leads the list of what is new, and a conformant node is no other one
// with another seed.
#include <algorithm>
#include <set>
#include <utility>

#include "base/text.hpp"
#include "catch.hpp"
#include "cli/proof/selftest.hpp"
#include "defects/defect.hpp"
#include "reports/compare.hpp"
#include "result/compare.hpp"
#include "shipped.hpp"

using namespace conform;
using cli::shipped::suites;

namespace {

result::RunResult run_of(std::vector<std::string> defects, std::uint64_t seed = 1, bool slow = false,
                         std::optional<std::uint64_t> shuffle = {}) {
  engine::RunOptions options;
  options.measure = true;
  options.plan.seed = seed;
  options.plan.slow = slow;
  options.plan.shuffle = shuffle;
  auto out = cli::simulate({.defects = std::move(defects)}, cli::shipped::reference(), suites().suite,
                           suites().catalogue, std::move(options), seed);
  REQUIRE(out.has_value());
  return std::move(out->result);
}

/// As `run_of`, without the scenarios of long transfers; few defects need them.
const result::RunResult& conformant(bool slow) {
  static const auto quick_run = run_of({}), slow_run = run_of({}, 1, true);
  return slow ? slow_run : quick_run;
}

std::string words(const result::Comparison& comparison) { return reports::compare_text(comparison, {}, {}); }

/// Every so manieth of all defects, so that each table has some.
std::vector<const refnode::Defect*> sample(std::size_t count) {
  const auto all = refnode::defects();
  std::vector<const refnode::Defect*> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(&all[i * all.size() / count]);
  return out;
}

}  // namespace

TEST_CASE("a rule that a defect violates leads what is new, for 48 of 50") {
  std::size_t right = 0;
  std::string wrong;
  for (const auto* defect : sample(50)) {
    std::set<std::string> violated;
    for (const auto& id : defect->violates)
      violated.insert(std::string(suites().catalogue.canonical(std::string(id)).value_or(std::string(id))));
    bool is_right = false;
    std::string told = "nothing";
    for (const bool slow : {false, true}) {
      const auto run = run_of({std::string(defect->id)}, 1, slow);
      const auto comparison = result::compare(conformant(slow), run);
      if (comparison.new_causes.empty()) continue;
      const auto& lead = comparison.new_causes.front();
      told = lead.fresh.front().finding->requirement;
      is_right = violated.contains(told) && exit_code(comparison, true) == 1;
      INFO(defect->id << "\n" << words(comparison));
      // And back: all of it is gone.
      const auto back = result::compare(run, conformant(slow));
      CHECK(back.new_causes.empty());
      CHECK(back.gone_causes.size() == comparison.new_causes.size());
      CHECK(exit_code(back, true) == 0);
      const auto itself = result::compare(run, run);
      INFO(words(back) << words(itself));
      CHECK(itself.is_same());
      break;
    }
    right += is_right ? 1 : 0;
    if (!is_right) wrong += std::string(defect->id) + ": " + told + "\n";
  }
  INFO(right << " of 50 led by a rule that is violated; not: " << wrong);
  CHECK(right >= 48);
}

TEST_CASE("a conformant node is the same with other seeds and in another order") {
  for (const std::uint64_t seed : {2U, 3U, 4U}) {
    const auto run = run_of({}, seed);
    const auto comparison = result::compare(conformant(false), run);
    INFO(words(comparison));
    CHECK(comparison.is_same());
  }
  const auto shuffled = run_of({}, 1, false, 7);
  const auto comparison = result::compare(conformant(false), shuffled);
  INFO(words(comparison));
  CHECK(comparison.is_same());
}

TEST_CASE("a node with a defect is the same with another seed") {
  for (const auto* defect : sample(6)) {
    const auto old = run_of({std::string(defect->id)}), run = run_of({std::string(defect->id)}, 2);
    const auto comparison = result::compare(old, run);
    INFO(defect->id << "\n" << words(comparison));
    CHECK(comparison.is_same());
  }
}

TEST_CASE("a second defect is new beside the one that was there") {
  const auto old = run_of({"1003-nonzero-write-accepted"});
  const auto run = run_of({"1003-nonzero-write-accepted", "1000-is-u16"});
  const auto comparison = result::compare(old, run);
  INFO(words(comparison));
  REQUIRE_FALSE(comparison.new_causes.empty());
  CHECK(comparison.known_failures == 1);
  for (const auto& each : comparison.new_causes) {
    for (const auto& place : each.fresh) CHECK(place.finding->requirement != "OD-1003-06");
  }
}
