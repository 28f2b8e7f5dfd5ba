// SPDX-License-Identifier: Apache-2.0
// No edit of the dictionary that can be seen from outside goes unnoticed.
#include "cli/proof/edit_matrix.hpp"

#include <algorithm>
#include <map>

#include "base/files.hpp"
#include "base/text.hpp"
#include "catch.hpp"
#include "cli/suite_folder.hpp"
#include "defects/edits.hpp"
#include "node/node.hpp"

using namespace conform;

namespace {

const std::string source = CONFORM_SOURCE_DIR;

/// Edits nobody notices, each with its reason.
std::map<std::string, std::string> known_survivors() {
  const auto text = read_file(source + "/harness/cli/tests/edit_survivors.txt", 1U << 20U);
  REQUIRE(text.has_value());
  std::map<std::string, std::string> out;
  for (const auto line : split(*text, '\n')) {
    if (trim(line).empty() || line.starts_with('#')) continue;
    const auto blank = line.find(' ');
    out[std::string(line.substr(0, blank))] = blank == std::string_view::npos ? "" : trim(line.substr(blank));
  }
  return out;
}

}  // namespace

// Every fifth edit, which takes some ten seconds; `canopen-conform selftest --edits` tries all.
TEST_CASE("edits of entries are noticed, but for those listed with a reason") {
  auto suites = cli::load_suites(source + "/suites", false);
  REQUIRE(suites.has_value());
  auto profile = device::load_profile_file(source + "/suites/devices/reference-node.yaml");
  REQUIRE(profile.has_value());
  const auto node = refnode::Node::create({});
  REQUIRE(node.has_value());
  const auto all = refnode::edits_of((*node)->dictionary());
  CHECK(all.size() > 1000);
  std::vector<std::string> tried, every;
  for (const auto& edit : all) {
    every.push_back(edit.id());
    if (every.size() % 5 == 0) tried.push_back(every.back());
  }
  const auto matrix = cli::edit_matrix(profile->profile, suites->suite, suites->catalogue, 1, 0, tried);
  REQUIRE(matrix.has_value());
  CHECK(matrix->edits.size() == tried.size());
  const auto survivors = matrix->survivors();
  const auto known = known_survivors();
  std::string unexpected, noticed, unexplained;
  for (const auto& id : survivors) {
    if (!known.contains(id)) unexpected += "\n  " + id;
  }
  for (const auto& [id, reason] : known) {
    const bool survives = std::ranges::find(survivors, id) != survivors.end();
    if (std::ranges::find(tried, id) != tried.end() && !survives) noticed += "\n  " + id;
    if (std::ranges::find(every, id) == every.end()) noticed += "\n  " + id;
    if (reason.empty()) unexplained += "\n  " + id;
  }
  INFO("not in edit_survivors.txt:" << unexpected);
  CHECK(unexpected.empty());
  INFO("listed in edit_survivors.txt, but noticed or gone:" << noticed);
  CHECK(noticed.empty());
  INFO("without a reason:" << unexplained);
  CHECK(unexplained.empty());
}
