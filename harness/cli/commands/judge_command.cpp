// SPDX-License-Identifier: Apache-2.0
// `judge`: the monitors over a recorded trace, without a device.
#include <fmt/format.h>

#include "base/files.hpp"
#include "base/text.hpp"
#include "cli/commands/commands.hpp"
#include "cli/run/judge.hpp"
#include "cli/run/known_device.hpp"
#include "cli/run/run_reports.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "engine/monitor_cases.hpp"
#include "reports/console.hpp"

namespace conform::cli {
namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30U;

}  // namespace

int judge_command(const JudgeCommand& options) {
  constexpr const char* tool = "canopen-conform " CONFORM_VERSION;
  RunReports files(absolute_paths(options.reports, {.bundle = options.bundle}));
  if (auto key = files.sign_with(options.sign); !key) return report_error(key.error(), exit_usage);
  if (auto begun = files.begin(tool, {options.capture, options.profile, options.eds, options.sign}); !begun)
    return report_error(begun.error(), exit_environment);
  const auto refuse = [&files](const Error& error) {
    files.not_begun(tool, error);
    return report_error(error, exit_usage);
  };
  auto root = find_suites(options.suites, options.profile);
  if (!root) return refuse(root.error());
  auto suites = load_suites(*root, use_colour(options.color, 2));
  if (!suites) return refuse(suites.error());
  const auto patterns = load_patterns(root->root);
  if (!patterns) return refuse(patterns.error());
  auto known = known_device({options.profile, options.eds, options.node, options.waivers}, std::nullopt);
  if (!known) return refuse(known.error());
  auto content = read_file(options.capture, most_bytes);
  if (!content) return refuse(content.error());
  auto recording = read_recording(*content, options.capture, options.interface);
  if (!recording) return refuse(recording.error());
  if (recording->capture.size() == 0) return refuse({"no frame is in the capture", options.capture, {}});

  JudgeOptions how;
  how.selection = {options.select, options.requirements, options.exclude};
  how.strict = options.strict;
  // A pattern that is about no monitor selects scenarios of a run, beside which all monitors watch; here it
  // selects nothing.
  const bool selected =
      how.selection.patterns.empty() || engine::names_a_monitor(how.selection, suites->catalogue);
  auto run = selected ? judge(*recording, known->profile, suites->catalogue, how) : result::RunResult{};
  if (run.cases.empty()) {
    return refuse({"nothing is selected: no monitor matches",
                   {},
                   "'canopen-conform list monitor' shows what there is"});
  }
  run.notes.insert(run.notes.begin(), known->notes.begin(), known->notes.end());
  run.tool = tool;
  run.likenesses = result::likenesses_of(run, *patterns);
  run.started_utc_ns = recording->info.epoch_ns;
  auto facts = suite_properties(*root);
  facts.push_back({"run.command", options.command});
  facts.push_back({"capture.file", options.capture});
  facts.push_back({"can.interface", recording->info.interface_name});
  known->files.push_back({role::recording, options.capture});
  auto taken = take_inputs(known->files, *root, files.has_bundle());
  if (!taken) return refuse(taken.error());
  const auto said = known->properties();
  facts.insert(facts.end(), said.begin(), said.end());
  facts.insert(facts.end(), taken->told.begin(), taken->told.end());
  if (files.has_bundle()) {
    if (auto kept = files.keep(tool, std::move(taken->inputs)); !kept)
      return report_error(kept.error(), exit_environment);
  }
  run.properties.insert(run.properties.begin(), facts.begin(), facts.end());

  const reports::Style style{use_colour(options.color, 1), terminal_width(), 0};
  for (const auto& each : run.cases) {
    const bool quiet =
        each.verdict == result::Verdict::pass || each.verdict == result::Verdict::not_applicable;
    if (!options.quiet || !quiet) print(reports::case_line(each, style) + "\n");
  }
  files.write(run, recording->capture, recording->info);
  print(reports::summary(run, style));
  return result::exit_code(run);
}

}  // namespace conform::cli
