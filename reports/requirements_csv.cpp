// SPDX-License-Identifier: Apache-2.0
#include "reports/requirements_csv.hpp"

#include <algorithm>
#include <vector>

#include "reports/csv.hpp"
#include "reports/phrases.hpp"
#include "reports/tally.hpp"

namespace conform::reports {
namespace {

using result::CaseResult;
using result::Judgement;
using result::RunResult;

struct Judged {
  std::size_t cases = 0;
  const CaseResult* worst_case = nullptr;
  const Judgement* worst = nullptr;
};

Judged judged(const RunResult& run, const std::string& requirement) {
  Judged out;
  for (const CaseResult& one : run.cases) {
    for (const Judgement& judgement : one.judgements) {
      if (judgement.requirement != requirement) continue;
      ++out.cases;
      if (out.worst != nullptr && judgement.verdict <= out.worst->verdict) continue;
      out.worst = &judgement;
      out.worst_case = &one;
    }
  }
  return out;
}

std::string decided_by(const Judgement& judgement) {
  if (!judgement.findings.empty()) return headline(judgement.findings.front());
  if (!judgement.reason.empty()) return judgement.reason;
  if (!judgement.decided_by) return {};
  return judgement.decided_by->step + " -> " + judgement.decided_by->actual;
}

}  // namespace

std::string requirements_csv(const RunResult& run) {
  std::string out = "requirement,level,clause,area,verdict,cases,case,decided by,waived\r\n";
  for (const RequirementVerdict& one : requirement_verdicts(run)) {
    const auto* info = run.requirement(one.id);
    const auto found = judged(run, one.id);
    const std::vector<std::string> cells{
        one.id,
        info == nullptr ? "" : info->level,
        info == nullptr ? "" : info->clause,
        info == nullptr ? "" : info->area,
        one.verdict ? std::string(verdict_words(*one.verdict)) : "not judged",
        std::to_string(found.cases),
        found.worst_case == nullptr ? "" : found.worst_case->name(),
        found.worst == nullptr ? "" : decided_by(*found.worst),
        found.worst == nullptr ? "" : found.worst->waived};
    out += csv_line(cells);
  }
  return out;
}

}  // namespace conform::reports
