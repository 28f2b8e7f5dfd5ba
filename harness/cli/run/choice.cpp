// SPDX-License-Identifier: Apache-2.0
#include "cli/run/choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "base/text.hpp"
#include "cli/run/run_source.hpp"
#include "cli/suite_folder.hpp"
#include "engine/engine.hpp"
#include "engine/monitor_cases.hpp"
#include "engine/plan.hpp"
#include "result/case_name.hpp"

namespace conform::cli {
namespace {

std::optional<std::size_t> number_of(std::string_view text) {
  std::size_t out = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return out;
}

/// A file of scenarios where an id is due: how its scenarios are played.
std::string hint_for_file(const std::string& pattern) {
  const std::filesystem::path file(pattern);
  if (file.extension() != ".yaml" && file.extension() != ".yml") return {};
  const auto folder = file.has_parent_path() ? file.parent_path().string() : std::string(".");
  return fmt::format("a file is read with its folder: --suites '{}' '{}/*'", folder, file.stem().string());
}

std::optional<engine::Shard> parse_shard(std::string_view text) {
  const auto slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto number = number_of(text.substr(0, slash)), of = number_of(text.substr(slash + 1));
  if (!number || !of || *number < 1 || *number > *of) return std::nullopt;
  return engine::Shard{*number, *of};
}

/// The cases that say nothing good of the device: failed, left open, or not run; nothing: all, because a
/// monitor has failed where no case is known to have run. Empty: all passed.
///
/// A monitor is no case that can be played: what it failed is met again in the cases that ran meanwhile, and
/// what it left open in those that are open as well, or in all where none is.
std::optional<std::set<std::string>> not_passed(const result::RunResult& run) {
  std::set<std::string> out, played;
  for (const auto& each : run.cases) {
    if (each.suite != "monitor") played.insert(each.name());
  }
  bool open_monitor = false;
  for (const auto& each : run.cases) {
    if (each.verdict < result::Verdict::inconclusive) continue;
    if (each.suite != "monitor") {
      out.insert(each.name());
      continue;
    }
    open_monitor = true;
    for (const auto& judgement : each.judgements) {
      if (judgement.verdict < result::Verdict::inconclusive) continue;
      for (const auto& finding : judgement.findings) {
        // Such as the preparation of the run, which is no case.
        if (!played.contains(finding.during)) return std::nullopt;
        out.insert(finding.during);
      }
    }
  }
  if (open_monitor && out.empty()) return std::nullopt;
  return out;
}

}  // namespace

Result<void> choose(const Choice& choice, engine::RunOptions& options) {
  if (!choice.shard.empty()) {
    const auto shard = parse_shard(choice.shard);
    if (!shard)
      return fail("'" + choice.shard + "' is no shard", {},
                  "--shard 2/5: the second of five parts of the run");
    options.plan.shard = *shard;
  }
  if (!choice.rerun_failed.empty()) {
    const auto run = read_run_to_compare(choice.rerun_failed);
    if (!run) return std::unexpected(run.error());
    options.plan.only = not_passed(*run);
  }
  if (!choice.budget.empty()) {
    const auto budget = parse_duration(choice.budget);
    if (!budget) return fail("'" + choice.budget + "' is no time", {}, "--budget '60 s'");
    options.budget = *budget;
  }
  if (choice.until_fail && choice.repeat < 2)
    return fail("--until-fail needs to know how often at most", {}, "--repeat 100 --until-fail");
  options.repeat = {choice.repeat, choice.until_fail};
  options.fail_fast = choice.fail_fast;
  return {};
}

Result<void> is_there(const LoadedSuites& suites, const device::Dictionary& described,
                      engine::PlanOptions plan) {
  const auto no_case = [&suites](const std::string& pattern) {
    const std::string nothing = "nothing is selected: no scenario and no monitor is named '" + pattern + "'";
    if (auto hint = hint_for_file(pattern); !hint.empty()) return fail(nothing, {}, std::move(hint));
    const auto ids = engine::case_ids(suites.suite);
    const std::vector<std::string_view> candidates(ids.begin(), ids.end());
    const auto near = did_you_mean(result::scenario_of(pattern), candidates);
    return fail(nothing, {},
                near.empty() ? "'canopen-conform list' shows what there is"
                             : "did you mean '" + std::string(near) + "'?");
  };
  if (const auto pattern = engine::names_nothing(suites.suite, plan.selection)) return no_case(*pattern);
  if (plan.only) {
    for (const auto& name : *plan.only) {
      if (!engine::names_a_case(suites.suite, name)) return no_case(name);
    }
  }
  const auto names_an_instance = [](const std::string& pattern) {
    return !result::instance_of(pattern).empty();
  };
  if (std::ranges::any_of(plan.selection.patterns, names_an_instance)) return {};
  plan.allowed = scenario::Risk::motion;
  plan.only.reset();
  plan.shard = {};
  if (engine::names_a_monitor(plan.selection, suites.catalogue) ||
      !engine::plan(suites.suite, suites.catalogue, described, plan).empty())
    return {};
  return fail("nothing is selected: no scenario matches", {}, "'canopen-conform list' shows what there is");
}

}  // namespace conform::cli
