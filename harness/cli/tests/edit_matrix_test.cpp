// SPDX-License-Identifier: Apache-2.0
// No edit of the dictionary that can be seen from outside goes unnoticed.
#include "cli/edit_matrix.hpp"

#include <algorithm>
#include <map>

#include "base/files.hpp"
#include "base/text.hpp"
#include "catch.hpp"
#include "cli/suite_folder.hpp"

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

TEST_CASE("every edit of every entry is noticed, but for those listed with a reason") {
  auto suites = cli::load_suites(source + "/suites", false);
  REQUIRE(suites.has_value());
  auto profile = device::load_profile_file(source + "/suites/devices/reference-node.yaml");
  REQUIRE(profile.has_value());
  const auto matrix = cli::edit_matrix(profile->profile, suites->suite, suites->catalogue, 1, 0);
  REQUIRE(matrix.has_value());
  CHECK(matrix->edits.size() > 500);
  const auto survivors = matrix->survivors();
  const auto known = known_survivors();
  std::string unexpected, noticed, unexplained;
  for (const auto& id : survivors) {
    if (!known.contains(id)) unexpected += "\n  " + id;
  }
  for (const auto& [id, reason] : known) {
    if (std::ranges::find(survivors, id) == survivors.end()) noticed += "\n  " + id;
    if (reason.empty()) unexplained += "\n  " + id;
  }
  INFO("not in edit_survivors.txt:" << unexpected);
  CHECK(unexpected.empty());
  INFO("listed in edit_survivors.txt, but noticed or gone:" << noticed);
  CHECK(noticed.empty());
  INFO("without a reason:" << unexplained);
  CHECK(unexplained.empty());
}
