// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/verdicts.hpp"

#include <utility>

namespace conform::cli {
namespace {

using result::Verdict;

bool worse(Verdict before, Verdict after) {
  return (after == Verdict::fail || after == Verdict::warn) && before < after &&
         before != Verdict::inconclusive;
}

}  // namespace

Verdicts verdicts_of(const result::RunResult& run) {
  Verdicts out;
  for (const auto& each : run.cases) {
    for (const auto& judgement : each.judgements)
      out[{judgement.requirement, each.name()}] = judgement.verdict;
  }
  return out;
}

Result<Verdicts> worse_with(const std::string& defect, const Bench& bench, engine::RunOptions options) {
  NodeSwitches switches{.defects = {defect}};
  // Every run begins with a look at all entries. The description that the node holds of itself is five times
  // as long as all others together, and a run of a few scenarios would do little else.
  if (!options.plan.selection.requirements.empty()) switches.variants = {"1021-short"};
  auto run = simulate(switches, bench.profile, bench.suite, bench.catalogue, std::move(options), bench.seed);
  if (!run) return std::unexpected(run.error());
  auto out = verdicts_of(run->result);
  std::erase_if(out, [&](const auto& each) {
    const auto before = bench.good.find(each.first);
    return !worse(before == bench.good.end() ? Verdict::pass : before->second, each.second);
  });
  return out;
}

}  // namespace conform::cli
