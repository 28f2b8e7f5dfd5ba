// SPDX-License-Identifier: Apache-2.0
// The verdicts counted by requirement instead of by case.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "result/run_result.hpp"

namespace conform::result {

/// A requirement over all cases of the run that can judge it.
struct RequirementVerdict {
  std::string id;
  std::optional<Verdict> verdict;  ///< the worst; none if only branches that were not taken would judge it
};

/// What one case says about one requirement it can judge; none: it took another branch.
[[nodiscard]] std::optional<Verdict> verdict_in(const CaseResult& one, const std::string& requirement);

/// Every requirement the cases mention, in the order of RunResult::requirements, strays behind them.
[[nodiscard]] std::vector<RequirementVerdict> requirement_verdicts(const RunResult& run);

}  // namespace conform::result
