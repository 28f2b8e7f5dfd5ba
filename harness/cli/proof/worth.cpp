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
  std::vector<Candidate> out;
  auto before = conformant.cases.empty() ? BusTime{} : conformant.cases.front().begin;
  for (const auto& each : conformant.cases) {
    if (each.suite == "monitor" || each.verdict == result::Verdict::not_applicable) continue;
    // With the way to its start, which lies between two cases.
    Candidate one{.played = &each, .takes = each.end - before, .defects = {}};
    before = each.end;
    if (const auto found = finders.find(each.name()); found != finders.end()) one.defects = found->second;
    out.push_back(std::move(one));
  }
  std::ranges::stable_sort(out, {}, &Candidate::takes);
  return out;
}

}  // namespace

std::vector<result::Worth> worths_of(const result::RunResult& conformant, std::span<const Blame> blames) {
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

}  // namespace conform::cli
