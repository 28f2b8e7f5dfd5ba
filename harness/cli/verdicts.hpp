// SPDX-License-Identifier: Apache-2.0
// What a defect changed: the verdicts of two runs side by side.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "result/run_result.hpp"

namespace conform::cli {

/// Verdict per (requirement, case): the unit of judgement.
using Verdicts = std::map<std::pair<std::string, std::string>, result::Verdict>;

[[nodiscard]] inline Verdicts verdicts_of(const result::RunResult& run) {
  Verdicts out;
  for (const auto& each : run.cases) {
    for (const auto& judgement : each.judgements)
      out[{judgement.requirement, each.name()}] = judgement.verdict;
  }
  return out;
}

/// Only a warning or a failure is a finding about the device; inconclusive and error prove nothing.
[[nodiscard]] inline bool worse(result::Verdict before, result::Verdict after) {
  using result::Verdict;
  return (after == Verdict::fail || after == Verdict::warn) && before < after &&
         before != Verdict::inconclusive;
}

}  // namespace conform::cli
