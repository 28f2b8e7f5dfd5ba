// SPDX-License-Identifier: Apache-2.0
#include "engine/tries.hpp"

#include <algorithm>
#include <utility>

namespace conform::engine {
namespace {

using result::CaseResult;
using result::Finding;
using result::Verdict;

/// Of four tries in which a rule always failed so many must be worth something: in the others the host itself
/// was late.
constexpr int least_of_machine = 2;

/// It stopped by itself at something that rests on time.
bool is_undecided(const CaseResult& seen) {
  if (seen.verdict != Verdict::inconclusive || !seen.rests_on.empty()) return false;
  const auto in_time = [](const Finding& finding) {
    return finding.rests_on_time && finding.verdict == Verdict::inconclusive;
  };
  return std::ranges::any_of(seen.setup_findings, in_time) ||
         std::ranges::any_of(seen.judgements, [&](const result::Judgement& each) {
           return std::ranges::any_of(each.findings, in_time);
         });
}

}  // namespace

bool Tries::again(const CaseResult& seen, const std::optional<HostTrouble>& trouble) {
  ++count_;
  seen_ = trusted_ = seen;
  if (trouble) distrust(trusted_, *trouble);
  Doubted doubted;
  bool failed = false;
  bool differs = trusted_.verdict != seen_.verdict;
  for (std::size_t i = 0; i < seen_.judgements.size(); ++i) {
    const auto& judged = seen_.judgements[i];
    if (judged.verdict == trusted_.judgements[i].verdict) continue;
    differs = true;
    if (judged.verdict != Verdict::fail && judged.verdict != Verdict::warn) continue;
    failed = failed || judged.verdict == Verdict::fail;
    doubted.insert(judged.requirement);
  }
  in_doubt_ = trouble && trouble->passes_by && (differs || is_undecided(seen_));
  if (!in_doubt_) return false;
  if (why_.empty()) why_ = trouble->why;
  for (const auto& judged : seen_.judgements) {
    if (judged.verdict == Verdict::pass) met_.insert(judged.requirement);
  }
  // What happened where the host itself was late shows nothing about the device.
  if (trouble->machine_only) {
    if (failed && !failed_once_) failed_once_ = trusted_;
    if (of_machine_++ == 0) always_ = doubted;
    std::erase_if(always_, [&](const std::string& rule) { return !doubted.contains(rule); });
  }
  return count_ < most;
}

CaseResult Tries::with_failures_of_all() const {
  auto out = seen_;
  out.verdict = Verdict::not_applicable;
  for (std::size_t i = 0; i < out.judgements.size(); ++i) {
    if (!always_.contains(out.judgements[i].requirement)) out.judgements[i] = trusted_.judgements[i];
    out.verdict = worst(out.verdict, out.judgements[i].verdict);
  }
  return out;
}

CaseResult Tries::outcome() {
  auto out = trusted_;
  std::string how;
  std::erase_if(always_, [this](const std::string& rule) { return met_.contains(rule); });
  if (in_doubt_ && of_machine_ >= least_of_machine && !always_.empty()) {
    out = with_failures_of_all();
    how = ", with the same failure each time";
  } else if (failed_once_ && trusted_.verdict != Verdict::fail) {
    out = *failed_once_;
    how = ", and did not fail each time";
  }
  if (count_ > 1) out.tried = std::to_string(count_) + " times" + how + ": " + why_;
  return out;
}

}  // namespace conform::engine
