// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/worth.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>

namespace conform::cli {
namespace {

/// So that a case that takes no time at all is not worth everything.
constexpr Duration least = std::chrono::milliseconds(5);

struct Candidate {
  const result::CaseResult* played = nullptr;
  Duration takes{};
  std::vector<std::size_t> defects;  ///< numbers of those it finds
};

std::vector<Candidate> candidates_of(const result::RunResult& conformant, std::span<const Blame> blames) {
  std::map<std::string, std::vector<std::size_t>, std::less<>> finders;
  for (std::size_t i = 0; i < blames.size(); ++i) {
    for (const auto& name : blames[i].seen_in) finders[name].push_back(i);
  }
  std::vector<const result::CaseResult*> played;
  for (const auto& each : conformant.cases) {
    if (each.suite != "monitor") played.push_back(&each);
  }
  std::ranges::stable_sort(played, {}, &result::CaseResult::begin);
  std::vector<Candidate> out;
  for (std::size_t i = 0; i < played.size(); ++i) {
    const auto& each = *played[i];
    if (each.verdict == result::Verdict::not_applicable) continue;
    // With the way to the next one: that puts back what this one changed.
    const auto end = i + 1 < played.size() ? played[i + 1]->begin : each.end;
    Candidate one{.played = &each, .takes = end - each.begin, .defects = {}};
    if (const auto found = finders.find(each.name()); found != finders.end()) one.defects = found->second;
    out.push_back(std::move(one));
  }
  std::ranges::stable_sort(out, {}, &Candidate::takes);
  return out;
}

/// By the times of this run.
std::vector<result::Worth> worths_by(const result::RunResult& conformant, std::span<const Blame> blames) {
  auto candidates = candidates_of(conformant, blames);
  std::vector<bool> found(blames.size(), false);
  std::set<std::string> judged;
  std::vector<result::Worth> out;
  const auto is_new = [&](std::size_t defect) { return !found[defect]; };
  const auto take = [&](std::vector<Candidate>::iterator one) {
    const auto finds = static_cast<std::size_t>(std::ranges::count_if(one->defects, is_new));
    out.push_back({one->played->name(), one->takes, finds});
    for (const auto defect : one->defects) found[defect] = true;
    judged.insert(one->played->requirements.begin(), one->played->requirements.end());
    candidates.erase(one);
  };
  while (true) {
    const auto rate = [&](const Candidate& one) {
      return static_cast<double>(std::ranges::count_if(one.defects, is_new)) /
             std::chrono::duration<double>(one.takes + least).count();
    };
    const auto best = std::ranges::max_element(candidates, {}, rate);
    if (best == candidates.end() || rate(*best) == 0) break;
    take(best);
  }
  const auto judges_new = [&](const Candidate& one) {
    return std::ranges::any_of(one.played->requirements,
                               [&](const auto& id) { return !judged.contains(id); });
  };
  while (true) {
    const auto next = std::ranges::find_if(candidates, judges_new);
    if (next == candidates.end()) break;
    take(next);
  }
  while (!candidates.empty()) take(candidates.begin());
  return out;
}

}  // namespace

Result<std::vector<result::Worth>> worths_of(const device::Profile& profile, const scenario::Suite& suite,
                                             const scenario::Catalogue& catalogue,
                                             std::span<const Blame> blames, std::uint64_t seed) {
  // Another order has other times; behind a few rounds little moves any more.
  constexpr int rounds = 4;
  std::vector<result::Worth> out;
  for (int round = 0; round < rounds; ++round) {
    engine::RunOptions run;
    const result::Worths worths(out);
    if (round > 0) {
      run.budget = std::chrono::hours(24);  // for the order: nothing is left out
      run.plan.worths = &worths;
    }
    const auto conformant = simulate({}, profile, suite, catalogue, std::move(run), seed);
    if (!conformant) return std::unexpected(conformant.error());
    out = worths_by(conformant->result, blames);
  }
  return out;
}

}  // namespace conform::cli
