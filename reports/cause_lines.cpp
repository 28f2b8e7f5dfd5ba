// SPDX-License-Identifier: Apache-2.0
#include "reports/cause_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports {

using result::CaseResult;
using result::Cause;

std::vector<BrokenRule> broken_rules(const Cause& cause) {
  std::vector<BrokenRule> out;
  std::map<std::string, std::set<const CaseResult*>> cases;
  for (const auto& place : cause.findings) {
    const auto& requirement = place.finding->requirement;
    auto row = std::ranges::find(out, requirement, &BrokenRule::requirement);
    if (row == out.end()) row = out.insert(out.end(), {requirement, place.verdict, 0, place});
    if (place.verdict > row->verdict) {
      row->verdict = place.verdict;
      row->first = place;
    }
    if (cases[requirement].insert(place.owner).second) ++row->cases;
  }
  return out;
}

std::string extent(const Cause& cause) {
  std::string text = counted(cause.cases.size(), "case");
  if (!cause.resting.empty())
    text += fmt::format(", {} more rest{} on it", cause.resting.size(), cause.resting.size() == 1 ? "s" : "");
  return text;
}

std::vector<const result::Likeness*> likenesses(const result::RunResult& run, const Cause& cause) {
  const auto name = cause.primary.owner->name();
  std::vector<const result::Likeness*> out;
  for (const auto& each : run.likenesses) {
    if (each.requirement == cause.primary.finding->requirement && each.case_name == name)
      out.push_back(&each);
  }
  return out;
}

std::string likeness_words(const result::RunResult& run, const Cause& cause) {
  std::string text;
  for (const auto* each : likenesses(run, cause)) {
    text += fmt::format("{} {}{}: {}", text.empty() ? "looks like" : "; or like", log_safe(each->name),
                        text.empty() ? " of the reference node" : "", prose(each->summary));
  }
  return text;
}

CauseOfCase causes_by_case(const std::vector<Cause>& causes) {
  CauseOfCase out;
  for (const auto& cause : causes) {
    for (const auto* one : cause.cases) out.try_emplace(one, &cause);
    for (const auto* one : cause.resting) out.try_emplace(one, &cause);
  }
  return out;
}

std::string consequence_words(const CauseOfCase& causes, const CaseResult& one) {
  const auto found = causes.find(&one);
  if (found == causes.end()) return {};
  const auto& primary = found->second->primary;
  if (primary.owner == &one) return {};
  const auto& requirement = primary.finding->requirement;
  const auto own = std::ranges::find(one.judgements, requirement, &result::Judgement::requirement);
  if (own != one.judgements.end() && !own->findings.empty()) return {};
  return fmt::format("consequence of {}, which {} in {}", log_safe(requirement),
                     primary.verdict == result::Verdict::fail ? "failed" : "warned",
                     log_safe(primary.owner->name()));
}

}  // namespace conform::reports
