// SPDX-License-Identifier: Apache-2.0
// What all writers say about a cause: one line for it, and one for each further requirement that it breaks.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "result/causes.hpp"

namespace conform::reports {

/// A requirement that a cause breaks beside the primary one.
struct BrokenRule {
  std::string requirement;
  result::Verdict verdict = result::Verdict::warn;  ///< the worst of it
  std::size_t cases = 0;
  result::Place first;
};
/// In the order of Cause::requirements, the primary one first.
[[nodiscard]] std::vector<BrokenRule> broken_rules(const result::Cause& cause);

/// "12 cases, 40 more rest on it": sanitised.
[[nodiscard]] std::string extent(const result::Cause& cause);

/// The known mistakes that a cause looks like, the most alike first.
[[nodiscard]] std::vector<const result::Likeness*> likenesses(const result::RunResult& run,
                                                              const result::Cause& cause);
/// "looks like ID of the reference node: what is wrong there; or like ID: ...": sanitised, empty where it
/// looks like none.
[[nodiscard]] std::string likeness_words(const result::RunResult& run, const result::Cause& cause);

/// For each case with a finding or without ground: the cause that explains it, the heaviest where there are
/// several.
using CauseOfCase = std::map<const result::CaseResult*, const result::Cause*>;
[[nodiscard]] CauseOfCase causes_by_case(const std::vector<result::Cause>& causes);
/// "consequence of OD-1017-05, which failed in cia301/...": empty for the case that the cause is told with,
/// and for a case that breaks the cause's own requirement.
[[nodiscard]] std::string consequence_words(const CauseOfCase& causes, const result::CaseResult& one);

}  // namespace conform::reports
