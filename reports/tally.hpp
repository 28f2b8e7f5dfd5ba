// SPDX-License-Identifier: Apache-2.0
// The verdicts counted by requirement instead of by case: what the summary tables of all writers show.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "result/requirement_verdicts.hpp"
#include "result/run_result.hpp"

namespace conform::reports {

using result::requirement_verdicts;
using result::RequirementVerdict;

struct AreaTally {
  std::string area;
  result::Counts counts;       ///< of requirements
  std::size_t not_judged = 0;  ///< requirements without a verdict
};

/// One row per area, in the order in which the requirements first name it.
[[nodiscard]] std::vector<AreaTally> tally_by_area(const result::RunResult& run);
/// The sum of the rows; its area is "total".
[[nodiscard]] AreaTally sum(const std::vector<AreaTally>& rows);
/// Cases of one verdict that have the same reason, in the order of their first case. Reasons of cases that
/// are not applicable are the same when they differ in numbers only: "1401h:00 is absent", "1402h:00 is
/// absent".
struct ReasonGroup {
  std::string reason;  ///< of the first case
  bool varies = false;
  std::vector<const result::CaseResult*> cases;
};
[[nodiscard]] std::vector<ReasonGroup> group_by_reason(const result::RunResult& run, result::Verdict verdict);

/// What the user could give, and how many cases that were not applicable want it. Most cases first.
struct WantTally {
  result::Want want;
  std::size_t cases = 0;
};
[[nodiscard]] std::vector<WantTally> tally_wants(const result::RunResult& run);

}  // namespace conform::reports
