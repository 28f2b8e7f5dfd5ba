// SPDX-License-Identifier: Apache-2.0
// Exploration of the mutants of the reference node: what a search finds of the mistakes that the suite
// misses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/proof/mutant_build.hpp"
#include "device/profile.hpp"
#include "scenario/catalogue.hpp"

namespace conform::cli {

struct MutantFound {
  const Mutant* mutant = nullptr;
  bool found = false;  ///< something was found, or the node crashed or hung
  std::string by{};    ///< "FAIL SDO-GEN-14: read 1000h:00 -> ...", "SIGSEGV"; empty: nothing
};

struct ExploreMutantsOptions {
  std::uint64_t seed = 1;
  std::size_t actions = 20'000;  ///< for each of them
  unsigned jobs = 0;             ///< processes at a time, 0: as many as the machine has cores
};

/// Explores each of `mutants` in a process of its own. The device has the fault and its model has not.
[[nodiscard]] Result<std::vector<MutantFound>> explore_mutants(const MutantBuild& build,
                                                               const std::vector<const Mutant*>& mutants,
                                                               const device::Profile& profile,
                                                               const scenario::Catalogue& catalogue,
                                                               const ExploreMutantsOptions& options);

/// Each of them with what was found, and the share.
[[nodiscard]] std::string explored_mutants_words(const std::vector<MutantFound>& found);

}  // namespace conform::cli
