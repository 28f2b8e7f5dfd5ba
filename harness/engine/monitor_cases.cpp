// SPDX-License-Identifier: Apache-2.0
#include "engine/monitor_cases.hpp"

#include <algorithm>
#include <set>

#include "result/case_name.hpp"

namespace conform::engine {
namespace {

using result::Verdict;

monitor::Cap cap_of(const scenario::Catalogue& catalogue, bool strict) {
  return [&catalogue, strict](std::string_view id) -> std::optional<Verdict> {
    const auto* requirement = catalogue.find(id);
    if (requirement == nullptr) return std::nullopt;
    const bool binding = strict || (requirement->level != "recommended" && requirement->level != "optional");
    return binding ? Verdict::fail : Verdict::warn;
  };
}

/// The cases of a result: those of scenarios, and behind them those of the monitors.
struct ConcludedCases {
  ConcludedCases(result::RunResult& out, const TraceRules& used)
      : rules(used),
        scenarios(std::span(out.cases).first(out.cases.size() - used.monitors.size())),
        own(std::span(out.cases).last(used.monitors.size())) {}

  void apply_waivers() const {
    for (auto& each : own) rules.waivers.apply(each);
  }

  const TraceRules& rules;
  std::span<const result::CaseResult> scenarios;
  std::span<result::CaseResult> own;
};

}  // namespace

Monitors chosen_monitors(const scenario::Selection& selection, const scenario::Catalogue& catalogue) {
  Monitors out;
  for (const auto& rule : monitor::rules()) {
    const auto planned = monitor::planned_case(rule, cap_of(catalogue, false));
    if (!planned.requirements.empty() && selection.takes_monitor(planned.id, planned.requirements, catalogue))
      out.push_back(&rule);
  }
  return out;
}

bool names_a_monitor(const scenario::Selection& selection, const scenario::Catalogue& catalogue) {
  const auto chosen = chosen_monitors(selection, catalogue);
  if (selection.patterns.empty()) return !chosen.empty();
  return std::ranges::any_of(chosen, [&selection](const monitor::Rule* rule) {
    return std::ranges::any_of(selection.patterns, [rule](const std::string& pattern) {
      return scenario::matches_pattern(pattern, monitor::case_id(*rule));
    });
  });
}

monitor::Facts facts_of(const device::Profile& profile) {
  // A short time in the profile makes a run short; CiA 301 has no limit, so nobody may hold it against the
  // device. That it hears what comes behind that time is what the run goes by, too.
  return {.node = profile.node,
          .boot_time = profile.boot_time,
          .nmt_time = std::max(profile.nmt_time, monitor::Facts{}.nmt_time),
          .deaf_time = profile.nmt_time,
          .alone = profile.claimed("only node on the bus")};
}

monitor::Facts facts_of_run(const device::Profile& profile) {
  auto facts = facts_of(profile);
  facts.power_is_known = true;
  return facts;
}

void plan_monitors(const Monitors& monitors, const scenario::Catalogue& catalogue, result::RunResult& out) {
  for (const auto* rule : monitors) {
    out.cases.push_back(monitor::planned_case(*rule, cap_of(catalogue, false)));
  }
}

void judge_trace(std::span<const can::CapturedFrame> frames, const TraceRules& rules,
                 const monitor::Facts& facts, std::span<const monitor::Loss> losses, result::RunResult& out) {
  const ConcludedCases cases(out, rules);
  monitor::judge(frames, facts, rules.monitors, cap_of(rules.catalogue, rules.strict), losses,
                 cases.scenarios, cases.own);
  cases.apply_waivers();
}

void conclude_trace(monitor::Watch& watch, std::span<const can::CapturedFrame> frames,
                    const TraceRules& rules, std::span<const monitor::Loss> losses,
                    std::span<const monitor::Loss> late, result::RunResult& out) {
  const ConcludedCases cases(out, rules);
  monitor::conclude(watch, frames, rules.profile.node, rules.monitors, cap_of(rules.catalogue, rules.strict),
                    losses, cases.scenarios, cases.own, late);
  cases.apply_waivers();
}

void withdraw_passes(std::span<result::CaseResult> monitors, const std::string& why) {
  for (auto& each : monitors) {
    bool open = false;
    for (auto& judgement : each.judgements) {
      if (judgement.verdict != Verdict::pass) continue;
      judgement.verdict = Verdict::inconclusive;
      open = true;
    }
    if (!open) continue;
    each.verdict = worst(each.verdict, Verdict::inconclusive);
    each.reason = why;
  }
}

void withdraw_all(std::span<result::CaseResult> monitors, const std::string& why) {
  for (auto& each : monitors) {
    if (each.verdict == Verdict::not_applicable) continue;
    each.verdict = Verdict::inconclusive;
    each.reason = why;
    for (auto& judgement : each.judgements) {
      if (judgement.verdict != Verdict::not_applicable) judgement.verdict = Verdict::inconclusive;
      for (auto& finding : judgement.findings) finding.verdict = Verdict::inconclusive;
    }
  }
}

bool names_a_case(const scenario::Suite& suite, std::string_view pattern) {
  // An instance in brackets belongs to a case that there may be on this device.
  const auto id = result::scenario_of(pattern);
  const auto matches = [id](std::string_view each) { return scenario::matches_pattern(id, each); };
  const auto holds = [&](const auto& file) {
    return std::ranges::any_of(file.scenarios, matches, &scenario::Scenario::id);
  };
  return std::ranges::any_of(suite.files, holds) ||
         std::ranges::any_of(monitor::rules(),
                             [&](const auto& rule) { return matches(monitor::case_id(rule)); });
}

std::optional<std::string> names_nothing(const scenario::Suite& suite, const scenario::Selection& selection) {
  for (const auto* patterns : {&selection.patterns, &selection.excludes}) {
    for (const auto& pattern : *patterns) {
      if (!names_a_case(suite, pattern)) return pattern;
    }
  }
  return std::nullopt;
}

std::vector<std::string> case_ids(const scenario::Suite& suite) {
  std::vector<std::string> out;
  for (const auto& file : suite.files) {
    for (const auto& each : file.scenarios) out.push_back(each.id);
  }
  for (const auto& rule : monitor::rules()) out.push_back(monitor::case_id(rule));
  return out;
}

void describe_requirements(const scenario::Catalogue& catalogue, result::RunResult& out) {
  std::set<std::string> mentioned;
  for (const auto& each : out.cases) mentioned.insert(each.requirements.begin(), each.requirements.end());
  for (const auto& id : mentioned) {
    if (const auto* requirement = catalogue.find(id)) out.requirements.push_back(requirement->info());
  }
}

}  // namespace conform::engine
