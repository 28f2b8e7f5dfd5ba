// SPDX-License-Identifier: Apache-2.0
#include "cli/selftest.hpp"

#include <algorithm>
#include <set>

#include "can/simulated_bus.hpp"
#include "defects/defect.hpp"
#include "node.hpp"

namespace conform::cli {
namespace {

using result::Verdict;

/// Verdict per (requirement, case): the unit of judgement.
using Verdicts = std::map<std::pair<std::string, std::string>, Verdict>;

Verdicts verdicts_of(const result::RunResult& run) {
  Verdicts out;
  for (const auto& each : run.cases) {
    for (const auto& judgement : each.judgements)
      out[{judgement.requirement, each.name()}] = judgement.verdict;
  }
  return out;
}

/// Only a warning or a failure is a finding about the device; inconclusive and error prove nothing.
bool worse(Verdict before, Verdict after) {
  return (after == Verdict::fail || after == Verdict::warn) && before < after &&
         before != Verdict::inconclusive;
}

}  // namespace

Result<SimulatedRun> simulate(const std::vector<std::string>& defects, const device::Profile& profile,
                              const scenario::Suite& suite, const scenario::Catalogue& catalogue,
                              engine::RunOptions options, std::uint64_t seed) {
  auto node = refnode::Node::create(
      {.node_id = profile.node.value(), .defects = defects, .storage = {}, .choices = {}});
  if (!node) return std::unexpected(node.error());
  can::SimulatedBus::Options bus_options;
  bus_options.seed = seed;
  can::SimulatedBus bus(bus_options);
  bus.attach(**node, "reference node");
  options.plan.seed = seed;
  SimulatedRun out;
  out.result = engine::run(bus.transport(), profile, suite, catalogue, options, out.capture);
  out.result.host = "simulation";
  return out;
}

bool KillMatrix::ok() const {
  const auto counts = conformant.counts();
  return counts.fail + counts.warn + counts.inconclusive + counts.error == 0 && counts.pass > 0 &&
         survivors().empty();
}

std::vector<std::string> KillMatrix::survivors() const {
  std::vector<std::string> out;
  for (const auto& defect : defects) {
    if (defect.killed_by.empty()) out.push_back(defect.id);
  }
  return out;
}

Result<KillMatrix> kill_matrix(const device::Profile& profile, const scenario::Suite& suite,
                               const scenario::Catalogue& catalogue, std::uint64_t seed,
                               const std::vector<std::string>& only) {
  KillMatrix out;
  auto conformant = simulate({}, profile, suite, catalogue, {}, seed);
  if (!conformant) return std::unexpected(conformant.error());
  out.conformant = std::move(conformant->result);
  const auto good = verdicts_of(out.conformant);
  std::set<std::string> proven, judged;
  for (const auto& [key, verdict] : good) {
    if (verdict != Verdict::not_applicable) judged.insert(key.first);
  }
  for (const auto& row : refnode::defects()) {
    if (!only.empty() && std::ranges::find(only, row.id) == only.end()) continue;
    DefectVerdict defect;
    defect.id = row.id;
    defect.summary = row.summary;
    for (const auto id : row.violates) {
      if (const auto canonical = catalogue.canonical(id)) {
        if (std::ranges::find(defect.violates, *canonical) == defect.violates.end())
          defect.violates.push_back(*canonical);
      } else {
        defect.unknown.emplace_back(id);
      }
    }
    // Scenarios of long transfers take ten times as long as all others together and are needed by few
    // defects.
    for (const bool slow : {false, true}) {
      if (slow && !defect.killed_by.empty()) break;
      engine::RunOptions options;
      options.plan.slow = slow;
      auto run = simulate({std::string(row.id)}, profile, suite, catalogue, options, seed);
      if (!run) return std::unexpected(run.error());
      for (const auto& [key, verdict] : verdicts_of(run->result)) {
        const auto before = good.find(key);
        if (!worse(before == good.end() ? Verdict::pass : before->second, verdict)) continue;
        const auto& [requirement, name] = key;
        if (std::ranges::find(defect.violates, requirement) != defect.violates.end()) {
          defect.killed_by.push_back(requirement + " " + std::string(to_string(verdict)) + " in " + name);
          if (std::ranges::find(defect.proves, requirement) == defect.proves.end())
            defect.proves.push_back(requirement);
          proven.insert(requirement);
        } else if (std::ranges::find(defect.bystanders, requirement) == defect.bystanders.end()) {
          defect.bystanders.push_back(requirement);
        }
      }
    }
    out.defects.push_back(std::move(defect));
  }
  std::ranges::set_difference(judged, proven, std::back_inserter(out.unproven));
  out.proven.assign(proven.begin(), proven.end());
  return out;
}

}  // namespace conform::cli
