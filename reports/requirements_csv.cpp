// SPDX-License-Identifier: Apache-2.0
#include "reports/requirements_csv.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "reports/phrases.hpp"
#include "reports/tally.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports {
namespace {

using result::CaseResult;
using result::Judgement;
using result::RunResult;

/// A device may call itself "=cmd|...": what a spreadsheet would run gets an apostrophe in front.
std::string cell(std::string_view text) {
  std::string out = prose(text);
  if (!out.empty() && std::string_view("=+-@").find(out.front()) != std::string_view::npos)
    out.insert(0, "'");
  if (out.find_first_of("\",") == std::string::npos) return out;
  std::string quoted = "\"";
  for (const char c : out) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

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
    for (std::size_t i = 0; i < cells.size(); ++i) out += (i == 0 ? "" : ",") + cell(cells[i]);
    out += "\r\n";
  }
  return out;
}

}  // namespace conform::reports
