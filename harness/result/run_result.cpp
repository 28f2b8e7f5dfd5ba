// SPDX-License-Identifier: Apache-2.0
#include "result/run_result.hpp"

#include <algorithm>
#include <set>

namespace conform::result {

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::not_applicable: return "not_applicable";
    case Verdict::pass: return "pass";
    case Verdict::waived: return "waived";
    case Verdict::warn: return "warn";
    case Verdict::inconclusive: return "inconclusive";
    case Verdict::error: return "error";
    case Verdict::fail: return "fail";
  }
  return "error";
}

void Counts::add(Verdict verdict) {
  switch (verdict) {
    case Verdict::not_applicable: ++not_applicable; break;
    case Verdict::pass: ++pass; break;
    case Verdict::waived: ++waived; break;
    case Verdict::warn: ++warn; break;
    case Verdict::inconclusive: ++inconclusive; break;
    case Verdict::error: ++error; break;
    case Verdict::fail: ++fail; break;
  }
}

Counts& Counts::operator+=(const Counts& more) {
  // A verdict that is new does not compile until it is added here.
  const auto& [a, b, c, d, e, f, g] = more;
  pass += a;
  waived += b;
  warn += c;
  fail += d;
  inconclusive += e;
  not_applicable += f;
  error += g;
  return *this;
}

Counts RunResult::counts() const {
  Counts counts;
  for (const CaseResult& one : cases) counts.add(one.verdict);
  return counts;
}

std::vector<std::string> RunResult::waived() const {
  std::set<std::string> out;
  for (const CaseResult& one : cases) {
    for (const Judgement& judgement : one.judgements) {
      if (!judgement.waived.empty()) out.insert(judgement.requirement);
    }
  }
  return {out.begin(), out.end()};
}

bool RunResult::without_time() const {
  return std::ranges::any_of(cases, [](const CaseResult& one) {
    return std::ranges::any_of(one.wants, [](const Want& want) { return want.text == longer_budget; });
  });
}

bool RunResult::has_wrong_waiver() const {
  return std::ranges::any_of(waivers, [](const WaiverUse& each) { return each.verdict == Verdict::fail; });
}

const RequirementInfo* RunResult::requirement(const std::string& id) const {
  // The list is sorted by whoever made it; a linear search does not depend on that and the list is short.
  const auto found = std::ranges::find(requirements, id, &RequirementInfo::id);
  return found == requirements.end() ? nullptr : &*found;
}

int exit_code(const RunResult& run) {
  if (run.signal != 0) return 128 + run.signal;  // the shell's convention: 130 for SIGINT, 143 for SIGTERM
  const Counts counts = run.counts();
  if (counts.fail != 0) return 1;
  if (run.has_wrong_waiver()) return 1;
  if (counts.error != 0 || counts.inconclusive != 0) return 3;
  // A run that stopped early is never green, and it says so even when nothing had been planned yet.
  if (run.aborted) return 3;
  if (!run.unwritten.empty()) return 3;
  // Monitors watch every run; that they saw nothing wrong does not make up for scenarios none of which
  // applied.
  const auto is_scenario = [](const CaseResult& one) { return one.suite != "monitor"; };
  const bool only_monitors = std::ranges::none_of(run.cases, is_scenario);
  const auto is_judged = [&](const CaseResult& one) {
    return (only_monitors || is_scenario(one)) &&
           (one.verdict == Verdict::pass || one.verdict == Verdict::waived || one.verdict == Verdict::warn);
  };
  if (std::ranges::none_of(run.cases, is_judged)) return 2;
  return 0;
}

}  // namespace conform::result
