// SPDX-License-Identifier: Apache-2.0
#include "result/patterns.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

namespace conform::result {
namespace {

/// The share of what both have in all that either has.
template <typename T>
double shared(const std::set<T>& one, const std::set<T>& other) {
  std::size_t both = 0;
  for (const auto& each : one) both += other.contains(each) ? 1U : 0U;
  const auto all = one.size() + other.size() - both;
  return all == 0 ? 0.0 : static_cast<double>(both) / static_cast<double>(all);
}

std::set<std::string> requirements_of(const Footprint& footprint) {
  std::set<std::string> out;
  for (const auto& [requirement, deviation] : footprint.signs) out.insert(requirement);
  return out;
}

/// What is among the causes of the run where it is violated: not what it could not judge, nor what is waived.
Judged judged_by(const RunResult& run) {
  Judged out;
  for (const auto& one : run.cases) {
    for (const auto& judgement : one.judgements) {
      const auto verdict = judgement.verdict;
      if (verdict != Verdict::pass && verdict != Verdict::warn && verdict != Verdict::fail) continue;
      out.requirements.insert(judgement.requirement);
      out.cases.insert(one.id);
    }
  }
  return out;
}

/// What of the set a run could have shown.
template <typename T, typename Visible>
std::set<T> only(const std::set<T>& all, const Visible& visible) {
  std::set<T> out;
  std::ranges::copy_if(all, std::inserter(out, out.end()), visible);
  return out;
}

}  // namespace

Footprint footprint_of(const Cause& cause) {
  Footprint out;
  out.lead = cause.primary.finding->requirement;
  for (const auto& place : cause.findings) {
    out.signs.emplace(place.finding->requirement, place.finding->deviation);
    out.cases.insert(place.owner->id);
  }
  if (out.cases.size() > few_cases) out.cases.clear();
  return out;
}

double likeness(const Footprint& seen, const Footprint& pattern, const Judged& judged) {
  if (seen.lead != pattern.lead) return 0;
  const Footprint visible{
      pattern.lead,
      only(pattern.signs, [&](const auto& sign) { return judged.requirements.contains(sign.first); }),
      {}};
  const double rules = shared(requirements_of(seen), requirements_of(visible));
  const double mean = (rules + shared(seen.signs, visible.signs)) / 2;
  return rules < least_alike || mean < least_alike ? 0 : mean;
}

std::vector<Alike> alike_to(const Footprint& seen, std::span<const Pattern> patterns, const Judged& judged) {
  std::vector<Alike> out;
  for (const auto& pattern : patterns) {
    const double share = likeness(seen, pattern.footprint, judged);
    if (share <= 0) continue;
    const auto cases =
        only(pattern.footprint.cases, [&](const auto& each) { return judged.cases.contains(each); });
    out.push_back({&pattern, share, shared(seen.cases, cases)});
  }
  const auto closeness = [](const Alike& each) { return std::pair(each.share, each.cases); };
  std::ranges::stable_sort(out, std::greater{}, closeness);
  const auto equal = std::ranges::count_if(
      out, [&](const Alike& each) { return closeness(each) >= closeness(out.front()); });
  if (static_cast<std::size_t>(equal) > most_alike) return {};
  out.resize(std::min(out.size(), most_alike));
  return out;
}

std::vector<Likeness> likenesses_of(const RunResult& run, std::span<const Pattern> patterns) {
  std::vector<Likeness> out;
  if (patterns.empty()) return out;
  const auto judged = judged_by(run);
  for (const auto& cause : causes_of(run)) {
    constexpr double whole = 100;
    for (const auto& each : alike_to(footprint_of(cause), patterns, judged)) {
      out.push_back({cause.primary.finding->requirement, cause.primary.owner->name(), each.pattern->name,
                     each.pattern->summary, static_cast<int>(std::lround(each.share * whole))});
    }
  }
  return out;
}

}  // namespace conform::result
