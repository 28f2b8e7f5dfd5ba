// SPDX-License-Identifier: Apache-2.0
// The mutants of canopen-conform-mutants: switches that the generated sources ask, and the table of what they
// do.
#include <array>

#include "cli/proof/mutant_build.hpp"
#include "mutants/switch.hpp"

namespace conform_mutant {

namespace {

constexpr std::array rows = std::to_array<conform::cli::Mutant>({
#include <mutants.inc>
});

constexpr std::size_t highest = rows.back().number;
std::array<std::uint8_t, highest + 1> passed{};

}  // namespace

std::uint32_t active = 0;
std::uint8_t* const reached = passed.data();

}  // namespace conform_mutant

namespace conform::cli {

const MutantBuild* mutant_build() {
  static const MutantBuild build{
      .mutants = conform_mutant::rows,
      .dropped = conform_mutant::highest - conform_mutant::rows.size(),
      .turn_on = [](std::uint32_t number) { conform_mutant::active = number; },
      .reached = [](std::uint32_t number) { return conform_mutant::passed[number] != 0; },
      .explained = CONFORM_MUTANTS_EXPLAINED};
  return &build;
}

}  // namespace conform::cli
