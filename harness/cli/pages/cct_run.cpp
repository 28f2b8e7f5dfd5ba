// SPDX-License-Identifier: Apache-2.0
#include "cli/pages/cct_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/text.hpp"
#include "cli/pages/cct_cases.hpp"
#include "eds/lint.hpp"

namespace conform::cli {
namespace {

using result::CaseResult;
using result::ComparedCase;
using result::Verdict;

constexpr std::string_view description_case = "1.0";  ///< the file is checked, no frame is sent

std::string_view outcome_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::fail: return "failed";
    case Verdict::error:
    case Verdict::inconclusive: return "not decided";
    case Verdict::waived:
    case Verdict::warn: return "warning";
    case Verdict::pass: return "passed";
    case Verdict::not_applicable: break;
  }
  return "skipped";
}

/// Requirements with this verdict, and where: "OD-RNG-01 in cia301/dictionary/lengths-and-ranges/...".
std::string reason_of(const CaseResult& one) {
  std::vector<std::string> ids;
  for (const auto& judgement : one.judgements) {
    if (judgement.verdict == one.verdict) ids.push_back(judgement.requirement);
  }
  const auto where = ids.empty() ? one.name() : join(ids, ", ") + " in " + one.name();
  return one.reason.empty() ? where : where + ": " + one.reason;
}

void check_description(const eds::EdsFile* description, ComparedCase& out) {
  if (description == nullptr) {
    out.outcome = "skipped";
    out.because = "no description of the device is given (--eds FILE)";
    return;
  }
  const auto report = eds::lint(*description);
  const auto errors = report.count(eds::Severity::error), warnings = report.count(eds::Severity::warning);
  out.outcome = errors > 0 ? "failed" : warnings > 0 ? "warning" : "passed";
  if (errors + warnings > 0)
    out.because = fmt::format("{} errors and {} warnings: canopen-conform eds lint {}", errors, warnings,
                              description->name);
}

}  // namespace

std::vector<std::string> cct_order(const scenario::Suite& suite, const scenario::Catalogue& catalogue) {
  std::vector<std::string> out;
  const auto scenarios = scenarios_by_case(suite, catalogue, {});
  for (const auto& each : cct_cases()) {
    const auto found = scenarios.find(each.number);
    if (found == scenarios.end()) continue;
    for (const auto& id : found->second) {
      if (std::ranges::find(out, id) == out.end()) out.push_back(id);
    }
  }
  return out;
}

std::vector<ComparedCase> cct_outcomes(const result::RunResult& run, const scenario::Suite& suite,
                                       const scenario::Catalogue& catalogue,
                                       const eds::EdsFile* description) {
  std::map<std::string, std::vector<const CaseResult*>, std::less<>> results;
  for (const auto& one : run.cases) results[one.id].push_back(&one);
  const auto scenarios = scenarios_by_case(suite, catalogue, {});
  std::vector<ComparedCase> out;
  for (const auto& each : cct_cases()) {
    auto& row = out.emplace_back(ComparedCase{std::string(each.number),
                                              std::string(each.group),
                                              std::string(each.title),
                                              "no counterpart",
                                              "",
                                              {}});
    if (each.number == description_case) {
      check_description(description, row);
      continue;
    }
    const auto corresponding = scenarios.find(each.number);
    if (corresponding == scenarios.end()) {
      row.because = "no scenario corresponds to it";
      continue;
    }
    const CaseResult* worst = nullptr;
    for (const auto& id : corresponding->second) {
      const auto found = results.find(id);
      if (found == results.end()) continue;
      for (const auto* one : found->second) {
        row.cases.push_back(one->name());
        if (worst == nullptr || worst->verdict < one->verdict) worst = one;
      }
    }
    if (worst == nullptr) {
      row.outcome = "skipped";
      row.because = "not selected in this run";
      continue;
    }
    row.outcome = outcome_of(worst->verdict);
    if (worst->verdict != Verdict::pass) row.because = reason_of(*worst);
  }
  return out;
}

}  // namespace conform::cli
