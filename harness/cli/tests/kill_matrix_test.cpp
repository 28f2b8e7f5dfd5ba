// SPDX-License-Identifier: Apache-2.0
// The suite proves itself: conformant node clean, every defect caught by the requirement it violates.
#include <algorithm>
#include <set>

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

/// Defects nobody catches yet, each with its reason: this list may only become shorter.
std::set<std::string> known_survivors() {
  const auto text =
      read_file(std::string(CONFORM_SOURCE_DIR) + "/harness/cli/tests/known_survivors.txt", 1U << 20U);
  REQUIRE(text.has_value());
  std::set<std::string> out;
  for (auto line : split(*text, '\n')) {
    line = trim(line.substr(0, line.find('#')));
    if (!line.empty()) out.insert(std::string(line.substr(0, line.find(' '))));
  }
  return out;
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
  const auto survivors = matrix().survivors();
  const auto known = known_survivors();
  std::string unexpected, revived;
  for (const auto& id : survivors) {
    if (!known.contains(id)) unexpected += "\n  " + id;
  }
  for (const auto& id : known) {
    if (std::ranges::find(survivors, id) == survivors.end()) revived += "\n  " + id;
  }
  INFO("survivors that are not in known_survivors.txt:" << unexpected);
  CHECK(unexpected.empty());
  INFO("listed in known_survivors.txt, but caught (or gone): take them out" << revived);
  CHECK(revived.empty());
  CHECK(matrix().defects.size() >= 60);
}

TEST_CASE("every defect names requirements that the catalogue knows") {
  for (const auto& defect : matrix().defects) {
    INFO(defect.id);
    CHECK(defect.unknown.empty());
    CHECK_FALSE(defect.violates.empty());
  }
}
