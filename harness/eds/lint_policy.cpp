// SPDX-License-Identifier: Apache-2.0
#include "eds/lint_policy.hpp"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "eds/lint_comments.hpp"

namespace conform::eds {
namespace {

/// All findings of a rule are gone, those that were not kept as well.
void forget(const Rule* rule, LintReport& report) {
  const auto left_out = report.left_out_of.find(rule);
  if (left_out == report.left_out_of.end()) return;
  report.left_out -= left_out->second;
  report.allowed += left_out->second;
  report.left_out_of.erase(left_out);
}

}  // namespace

LintReport apply(const LintPolicy& policy, LintReport report, std::string_view bytes, const EdsFile& file) {
  auto comments = read_lint_comments(bytes, file);
  std::vector<bool> used(comments.allowed.size());
  report.allowed += std::erase_if(report.findings, [&](const Finding& finding) {
    bool covered = false;
    for (std::size_t i = 0; i < comments.allowed.size(); ++i) {
      if (!comments.allowed[i].covers(finding)) continue;
      covered = used[i] = true;
    }
    return covered;
  });
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i])
      comments.findings.push_back(nothing_allowed(comments.allowed[i]));
    else if (comments.allowed[i].whole_file)
      forget(comments.allowed[i].rule, report);
  }
  std::ranges::move(comments.findings, std::back_inserter(report.findings));
  std::ranges::sort(report.findings, [](const Finding& a, const Finding& b) {
    return std::tie(a.at, a.rule->code, a.message) < std::tie(b.at, b.rule->code, b.message);
  });
  report.allowed += std::erase_if(report.findings,
                                  [&](const Finding& finding) { return policy.off.contains(finding.rule); });
  for (const auto* rule : policy.off) forget(rule, report);
  for (auto& finding : report.findings) {
    const auto other = policy.severity.find(finding.rule);
    if (other != policy.severity.end()) finding.decided = other->second;
  }
  return report;
}

}  // namespace conform::eds
