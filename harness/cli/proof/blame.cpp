// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/blame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <set>

#include "base/text.hpp"
#include "result/causes.hpp"

namespace conform::cli {
namespace {

bool contains(const std::vector<std::string>& list, const std::string& one) {
  return std::ranges::find(list, one) != list.end();
}

std::string words_of(const result::Cause& cause) {
  return fmt::format("{}, {}, {} cases, {} resting: {}", cause.about, to_string(cause.verdict),
                     cause.cases.size(), cause.resting.size(), join(cause.requirements, " "));
}

/// Of a run in which something was wrong.
std::set<std::string> cases_that_told(const result::RunResult& run) {
  const auto is_told = [](result::Verdict verdict) {
    return verdict == result::Verdict::fail || verdict == result::Verdict::warn;
  };
  std::set<std::string> out;
  for (const auto& each : run.cases) {
    if (!is_told(each.verdict)) continue;
    if (each.suite != "monitor") {
      out.insert(each.name());
      continue;
    }
    for (const auto& judgement : each.judgements) {
      for (const auto& finding : judgement.findings) {
        if (is_told(finding.verdict) && !finding.during.empty()) out.insert(finding.during);
      }
    }
  }
  return out;
}

/// The whole suite against a node with `defects`. Scenarios of long transfers take ten times as long as all
/// others together; few defects need them.
Result<result::RunResult> run_against(const std::vector<std::string>& defects, const Bench& bench) {
  for (const bool slow : {false, true}) {
    engine::RunOptions options;
    options.plan.slow = slow;
    auto run = simulate({.defects = defects}, bench.profile, bench.suite, bench.catalogue, std::move(options),
                        bench.seed);
    if (!run) return std::unexpected(run.error());
    if (slow || !result::causes_of(run->result).empty()) return std::move(run->result);
  }
  return result::RunResult{};
}

}  // namespace

Result<Blame> blame_of(const DefectVerdict& defect, const Bench& bench,
                       std::span<const result::Pattern> known) {
  Blame out;
  out.defect = defect.id;
  out.violates = defect.violates;
  const auto run = run_against({defect.id}, bench);
  if (!run) return std::unexpected(run.error());
  const auto causes = result::causes_of(*run);
  out.pattern = {defect.id, defect.summary, {}};
  if (!causes.empty()) out.pattern.footprint = result::footprint_of(causes.front());
  for (const auto& each : result::likenesses_of(*run, known)) out.named.push_back(each.name);
  out.seen_in = cases_that_told(*run);
  for (const auto& cause : causes) {
    out.causes.push_back(cause.primary.finding->requirement);
    out.about.push_back(words_of(cause));
    for (const auto& place : cause.findings) out.parts.insert(place.part());
    out.broken.insert(cause.requirements.begin(), cause.requirements.end());
  }
  out.right = !out.causes.empty() && contains(defect.violates, out.causes.front());
  return out;
}

std::vector<PairOfDefects> pairs_of(const std::vector<Blame>& blames, std::size_t count, std::uint64_t seed) {
  std::vector<const Blame*> right;
  for (const auto& blame : blames) {
    if (blame.single_and_right()) right.push_back(&blame);
  }
  std::vector<PairOfDefects> out;
  if (right.size() < 2) return out;
  std::mt19937_64 random(seed);
  const auto drawn = [&] { return static_cast<std::size_t>(random() % right.size()); };
  std::set<std::pair<std::size_t, std::size_t>> taken;
  // There may be fewer pairs than asked for.
  for (std::size_t tries = 0; out.size() < count && tries < 50 * count; ++tries) {
    auto pair = std::minmax({drawn(), drawn()});
    const auto& [one, other] = std::tie(*right[pair.first], *right[pair.second]);
    const bool shared =
        std::ranges::any_of(one.parts, [&](const std::string& part) { return other.parts.contains(part); });
    if (!shared && taken.insert(pair).second) out.push_back({one, other});
  }
  return out;
}

Result<PairBlame> blame_of(const PairOfDefects& pair, const Bench& bench) {
  PairBlame out;
  out.first = pair.first.defect;
  out.second = pair.second.defect;
  const auto run = run_against({out.first, out.second}, bench);
  if (!run) return std::unexpected(run.error());
  const auto causes = result::causes_of(*run);
  for (const auto& cause : causes) out.about.push_back(words_of(cause));
  std::set<std::size_t> telling;
  for (const auto& [defect, other] :
       {std::pair(&pair.first, &pair.second), std::pair(&pair.second, &pair.first)}) {
    bool seen = false, told = false;
    for (std::size_t i = 0; i < causes.size(); ++i) {
      const auto& cause = causes[i];
      seen = seen || std::ranges::any_of(cause.requirements, [&](const auto& each) {
               return contains(defect->violates, each) && !other->broken.contains(each);
             });
      if (!contains(defect->violates, cause.requirements.front())) continue;
      told = true;
      telling.insert(i);
    }
    out.hidden = out.hidden || !seen;
    out.swallowed = out.swallowed || (seen && !told);
  }
  out.swallowed = out.swallowed || (!out.hidden && telling.size() < 2);
  return out;
}

}  // namespace conform::cli
