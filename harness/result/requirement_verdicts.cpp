// SPDX-License-Identifier: Apache-2.0
#include "result/requirement_verdicts.hpp"

#include <map>

namespace conform::result {

std::optional<Verdict> verdict_in(const CaseResult& one, const std::string& requirement) {
  std::optional<Verdict> verdict;
  for (const Judgement& judgement : one.judgements) {
    if (judgement.requirement != requirement) continue;
    verdict = verdict ? worst(*verdict, judgement.verdict) : judgement.verdict;
  }
  if (verdict) return verdict;
  // Not judged although the case could have: a case that did not get to its judgements speaks for all of
  // them, one that did took another branch.
  const bool no_word = one.verdict == Verdict::not_applicable || one.verdict == Verdict::inconclusive ||
                       one.verdict == Verdict::error;
  return no_word ? std::optional(one.verdict) : std::nullopt;
}

std::vector<RequirementVerdict> requirement_verdicts(const RunResult& run) {
  std::map<std::string, std::optional<Verdict>> by_id;
  const auto take = [&](const CaseResult& one, const std::string& id) {
    auto& known = by_id[id];
    const auto verdict = verdict_in(one, id);
    if (verdict) known = known ? worst(*known, *verdict) : *verdict;
  };
  for (const CaseResult& one : run.cases) {
    for (const std::string& id : one.requirements) take(one, id);
    for (const Judgement& judgement : one.judgements) take(one, judgement.requirement);
  }
  by_id.erase(std::string{});

  std::vector<RequirementVerdict> all;
  for (const RequirementInfo& info : run.requirements) {
    const auto found = by_id.find(info.id);
    if (found == by_id.end()) continue;
    all.push_back({info.id, found->second});
    by_id.erase(found);
  }
  for (const auto& [id, verdict] : by_id) all.push_back({id, verdict});
  return all;
}

}  // namespace conform::result
