// SPDX-License-Identifier: Apache-2.0
// The monitors as cases of a run: which are chosen, how they are planned, and their judgement of the trace.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "can/capture.hpp"
#include "device/profile.hpp"
#include "engine/waivers.hpp"
#include "monitor/watch.hpp"
#include "result/run_result.hpp"
#include "scenario/catalogue.hpp"
#include "scenario/loader.hpp"
#include "scenario/selection.hpp"

namespace conform::engine {

using Monitors = std::vector<const monitor::Rule*>;

/// Monitors run with every selection of scenarios; a pattern "monitor/...", a requirement or an exclusion
/// chooses among them. Those whose requirements the catalogue does not have are left out.
[[nodiscard]] Monitors chosen_monitors(const scenario::Selection& selection,
                                       const scenario::Catalogue& catalogue);
/// A pattern or a requirement names a monitor, so that there is something to run without any scenario.
[[nodiscard]] bool names_a_monitor(const scenario::Selection& selection,
                                   const scenario::Catalogue& catalogue);

/// What monitors may know of the device.
[[nodiscard]] monitor::Facts facts_of(const device::Profile& profile);
/// The same in a run, in which nobody switches the power of the device unseen.
[[nodiscard]] monitor::Facts facts_of_run(const device::Profile& profile);

/// Appends the planned cases behind those of the scenarios.
void plan_monitors(const Monitors& monitors, const scenario::Catalogue& catalogue, result::RunResult& out);
/// What a trace was judged with.
struct TraceRules {
  const Monitors& monitors;
  const device::Profile& profile;
  const scenario::Catalogue& catalogue;
  Waivers& waivers;
  bool strict = false;
};
/// Judges a recorded trace by `facts`: the last cases of `out` are those of the monitors.
void judge_trace(std::span<const can::CapturedFrame> frames, const TraceRules& rules,
                 const monitor::Facts& facts, std::span<const monitor::Loss> losses, result::RunResult& out);
/// The same of the trace of a run, which `watch` has seen to its end. `late`: where the machine was late that
/// the device shares.
void conclude_trace(monitor::Watch& watch, std::span<const can::CapturedFrame> frames,
                    const TraceRules& rules, std::span<const monitor::Loss> losses,
                    std::span<const monitor::Loss> late, result::RunResult& out);

/// What the monitors passed is open, for the given reason; what they found stays.
void withdraw_passes(std::span<result::CaseResult> monitors, const std::string& why);
/// Nor does it count what they found.
void withdraw_all(std::span<result::CaseResult> monitors, const std::string& why);

/// Whether a pattern names a scenario or a monitor that there is.
[[nodiscard]] bool names_a_case(const scenario::Suite& suite, std::string_view pattern);

/// The first pattern, of what is taken or left out, that names no case at all: a misspelt one, which would
/// leave its part of the run out, or in, without a word.
[[nodiscard]] std::optional<std::string> names_nothing(const scenario::Suite& suite,
                                                       const scenario::Selection& selection);
/// Ids of all scenarios and monitors.
[[nodiscard]] std::vector<std::string> case_ids(const scenario::Suite& suite);

/// Fills RunResult::requirements with what the cases mention.
void describe_requirements(const scenario::Catalogue& catalogue, result::RunResult& out);

}  // namespace conform::engine
