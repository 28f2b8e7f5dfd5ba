// SPDX-License-Identifier: Apache-2.0
// Findings grouped by what causes them: one fault of a device shows in many cases, and a reader wants to hear
// of it once. How it is decided stands in docs/decisions/0002-one-cause-one-finding.md.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "result/explanations.hpp"
#include "result/run_result.hpp"

namespace conform::result {

/// One fault, as far as can be told from outside.
struct Cause {
  Place primary;  ///< what the others rest on: nearest to the frame, then first in time
  std::string
      about;  ///< the part of the device: "heartbeat producer"; or the deviation that many parts share
  Verdict verdict = Verdict::fail;         ///< the worst of its findings
  std::vector<Place> findings;             ///< fail and warn, the primary first, then in the order of the run
  std::vector<const CaseResult*> cases;    ///< with a finding of this cause, in the order of the run
  std::vector<const CaseResult*> resting;  ///< inconclusive because they rest on a requirement of this cause
  std::vector<std::string> requirements;   ///< violated, the primary first, each once
};

/// Every `fail` and `warn` of the run in one cause each; failures first, then by weight (cases concerned).
/// The result points into `run`.
[[nodiscard]] std::vector<Cause> causes_of(const RunResult& run);

}  // namespace conform::result
