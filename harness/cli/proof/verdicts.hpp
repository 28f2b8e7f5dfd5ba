// SPDX-License-Identifier: Apache-2.0
// What a defect changes: the verdicts of two runs side by side.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "cli/proof/selftest.hpp"

namespace conform::cli {

/// Verdict per (requirement, case): the unit of judgement.
using Verdicts = std::map<std::pair<std::string, std::string>, result::Verdict>;

[[nodiscard]] Verdicts verdicts_of(const result::RunResult& run);

/// What the suite judges, with what to run it, and what comes of it on the conformant node.
struct Bench {
  const device::Profile& profile;
  const scenario::Suite& suite;
  const scenario::Catalogue& catalogue;
  std::uint64_t seed;
  const Verdicts& good;
};

/// Runs the suite against the node with one defect: what is worse than on the conformant node. Only a warning
/// or a failure is a finding about the device; inconclusive and error prove nothing.
[[nodiscard]] Result<Verdicts> worse_with(const std::string& defect, const Bench& bench,
                                          engine::RunOptions options);

}  // namespace conform::cli
