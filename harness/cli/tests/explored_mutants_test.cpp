// SPDX-License-Identifier: Apache-2.0
// Exploration of mutants, with a build whose only mutant changes nothing: what is found of real ones only
// canopen-conform-mutants can tell.
#include "cli/proof/explored_mutants.hpp"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "catch.hpp"
#include "shipped.hpp"

using namespace conform;
using cli::Mutant;

namespace {

constexpr std::array rows{Mutant{.number = 7,
                                 .file = "sdo/server.cpp",
                                 .line = 12,
                                 .function = "SdoServer::serve",
                                 .kind = "comparison",
                                 .original = "a < b",
                                 .mutated = "a <= b"}};

std::vector<cli::MutantFound> explore(const cli::MutantBuild& build) {
  auto found = cli::explore_mutants(build, {&rows[0]}, cli::shipped::reference(),
                                    cli::shipped::suites().catalogue, {.actions = 300, .jobs = 1});
  REQUIRE(found.has_value());
  return *found;
}

}  // namespace

TEST_CASE("A mutant that changes nothing is not found, and stands with its place") {
  const cli::MutantBuild build{
      .mutants = rows, .dropped = 0, .turn_on = [](std::uint32_t) {}, .reached = {}, .explained = {}};
  const auto found = explore(build);
  REQUIRE(found.size() == 1);
  CHECK_FALSE(found[0].found);
  CHECK(cli::explored_mutants_words(found) ==
        "not found   7 sdo/server.cpp:12 SdoServer::serve `a < b` -> `a <= b`\n"
        "exploration: 0 of 1 mutants found (0.0 %)\n");
}

TEST_CASE("A mutant that ends its process is found") {
  const cli::MutantBuild build{.mutants = rows,
                               .dropped = 0,
                               .turn_on =
                                   [](std::uint32_t number) {
                                     if (number == 7) std::abort();
                                   },
                               .reached = {},
                               .explained = {}};
  const auto found = explore(build);
  REQUIRE(found.size() == 1);
  CHECK(found[0].found);
  CHECK(found[0].by == "SIGABRT");
}

TEST_CASE("The fault is in the device alone: between two calls of its node there is none") {
  static std::uint32_t now = 0;
  static bool is_nested = false;
  const cli::MutantBuild build{.mutants = rows,
                               .dropped = 0,
                               .turn_on =
                                   [](std::uint32_t number) {
                                     is_nested = is_nested || (number != 0 && now != 0);
                                     now = number;
                                     if (is_nested) std::abort();
                                   },
                               .reached = {},
                               .explained = {}};
  CHECK_FALSE(explore(build)[0].found);
}
