// SPDX-License-Identifier: Apache-2.0
// `judge`: the monitors over a recorded trace, without a device.
#include <fmt/format.h>

#include "base/files.hpp"
#include "base/text.hpp"
#include "cli/commands/commands.hpp"
#include "cli/run/judge.hpp"
#include "cli/run/known_device.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "engine/monitor_cases.hpp"
#include "reports/console.hpp"
#include "reports/junit.hpp"
#include "reports/markdown.hpp"

namespace conform::cli {
namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30U;

}  // namespace

int judge_command(const JudgeCommand& options) {
  auto root = find_suites(options.suites, options.profile);
  if (!root) return report_error(root.error(), exit_usage);
  auto suites = load_suites(*root, use_colour(options.color, 2));
  if (!suites) return report_error(suites.error(), exit_usage);
  auto known = known_device({options.profile, options.eds, options.node}, std::nullopt);
  if (!known) return report_error(known.error(), exit_usage);
  auto content = read_file(options.capture, most_bytes);
  if (!content) return report_error(content.error(), exit_usage);
  auto recording = read_recording(*content, options.capture, options.interface);
  if (!recording) return report_error(recording.error(), exit_usage);
  if (recording->capture.size() == 0)
    return report_error({"no frame is in the capture", options.capture, {}}, exit_usage);

  JudgeOptions how;
  how.selection = {options.select, options.requirements, options.exclude};
  how.strict = options.strict;
  // A pattern that is about no monitor selects scenarios of a run, beside which all monitors watch; here it
  // selects nothing.
  const bool selected =
      how.selection.patterns.empty() || engine::names_a_monitor(how.selection, suites->catalogue);
  auto run = selected ? judge(*recording, known->profile, suites->catalogue, how) : result::RunResult{};
  if (run.cases.empty()) {
    return report_error(
        {"nothing is selected: no monitor matches", {}, "'canopen-conform list monitor' shows what there is"},
        exit_usage);
  }
  run.notes.insert(run.notes.begin(), known->notes.begin(), known->notes.end());
  run.tool = "canopen-conform " CONFORM_VERSION;
  run.started_utc_ns = recording->info.epoch_ns;
  auto facts = suite_properties(*root);
  facts.push_back({"capture.file", options.capture});
  facts.push_back({"can.interface", recording->info.interface_name});
  run.properties.insert(run.properties.begin(), facts.begin(), facts.end());

  const reports::Style style{use_colour(options.color, 1), terminal_width(), 0};
  for (const auto& each : run.cases) {
    const bool quiet =
        each.verdict == result::Verdict::pass || each.verdict == result::Verdict::not_applicable;
    if (!options.quiet || !quiet) print(reports::case_line(each, style) + "\n");
  }
  bool failed = false;
  const auto write = [&failed](const std::string& path, const std::string& text) {
    if (path.empty()) return;
    if (auto written = write_file_atomically(path, text); !written) {
      failed = true;
      report_error(written.error(), 0);
    }
  };
  if (!options.junit.empty()) write(options.junit, reports::junit(run));
  if (!options.markdown.empty()) write(options.markdown, reports::markdown(run));
  print(reports::summary(run, style));
  const auto code = result::exit_code(run);
  return failed && code == 0 ? exit_environment : code;
}

}  // namespace conform::cli
