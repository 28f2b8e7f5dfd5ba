// SPDX-License-Identifier: Apache-2.0
// The suite proves itself: conformant node clean, every defect caught by the requirement it violates.
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "base/text.hpp"
#include "catch.hpp"
#include "cli/proof/selftest.hpp"
#include "device/profile.hpp"
#include "shipped.hpp"

using namespace conform;
using result::Verdict;

namespace {

const cli::KillMatrix& matrix() {
  static const cli::KillMatrix computed = [] {
    const auto& suites = cli::shipped::suites();
    auto out = cli::kill_matrix(cli::shipped::reference(), suites.suite, suites.catalogue, {});
    REQUIRE(out.has_value());
    return std::move(*out);
  }();
  return computed;
}

/// What is not proven yet, each with its reason: these lists may only become shorter.
std::set<std::string> known(const std::string& list) {
  const auto text = read_file(std::string(CONFORM_SOURCE_DIR) + "/harness/cli/tests/" + list, 1U << 20U);
  REQUIRE(text.has_value());
  std::set<std::string> out;
  for (auto line : split(*text, '\n')) {
    line = trim(line.substr(0, line.find('#')));
    if (!line.empty()) out.insert(std::string(line.substr(0, line.find(' '))));
  }
  return out;
}

/// What is open is known, and what is known is open.
void check_open(const std::vector<std::string>& open, const std::string& list) {
  const auto listed = known(list);
  std::string unexpected, settled;
  for (const auto& id : open) {
    if (!listed.contains(id)) unexpected += "\n  " + id;
  }
  for (const auto& id : listed) {
    if (std::ranges::find(open, id) == open.end()) settled += "\n  " + id;
  }
  INFO("open, but not in " << list << ":" << unexpected);
  CHECK(unexpected.empty());
  INFO("in " << list << ", but settled (or gone): take them out" << settled);
  CHECK(settled.empty());
}

}  // namespace

TEST_CASE("the conformant reference node passes everything, with no warning") {
  const auto& run = matrix().conformant;
  for (const auto& each : run.cases) {
    INFO(each.name() << ": " << each.reason);
    CHECK((each.verdict == Verdict::pass || each.verdict == Verdict::not_applicable));
  }
  CHECK(run.counts().pass > 100);
  CHECK(run.notes.empty());
  CHECK_FALSE(run.aborted.has_value());
}

TEST_CASE("every defect spoils the expectation of a requirement it violates") {
  check_open(matrix().survivors(), "known_survivors.txt");
  CHECK(matrix().defects.size() >= 60);
}

TEST_CASE("every rule that the suite judges is proven by a defect that violates it") {
  check_open(matrix().unproven, "known_unproven.txt");
}

TEST_CASE("a rule that stands behind another one of its defect is proven alone") {
  const auto& suites = cli::shipped::suites();
  const auto one = cli::kill_matrix(cli::shipped::reference(), suites.suite, suites.catalogue,
                                    {.only = {"nmt-reset-ignored-in-preop"}});
  REQUIRE(one.has_value());
  CHECK(std::ranges::find(one->proven, "NMT-BOOT-02") != one->proven.end());
  CHECK(std::ranges::find(one->proven, "NMT-FSA-07") != one->proven.end());
}

TEST_CASE("every defect names requirements that the catalogue knows") {
  for (const auto& defect : matrix().defects) {
    INFO(defect.id);
    CHECK(defect.unknown.empty());
    CHECK_FALSE(defect.violates.empty());
  }
}
