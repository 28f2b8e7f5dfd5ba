// SPDX-License-Identifier: Apache-2.0
// `report`: the reports of a run anew, from what it found (result.json) or from its journal.
#include "cli/commands/commands.hpp"
#include "cli/run/run_reports.hpp"
#include "cli/run/run_source.hpp"
#include "cli/run/terminal.hpp"
#include "reports/console.hpp"

namespace conform::cli {

int report_command(const ReportCommand& options) {
  auto source = read_run(options.source);
  if (!source) return report_error(source.error(), exit_usage);
  auto paths = absolute_paths(
      options.reports, {.capture = options.capture, .captures = options.captures, .bundle = options.bundle});
  const bool chosen =
      !paths.reports.empty() || !paths.capture.empty() || !paths.captures.empty() || !paths.bundle.empty();
  RunReports reports(chosen ? std::move(paths) : source->reports);
  if (auto apart = reports.captures_apart(); !apart) return report_error(apart.error(), exit_usage);
  if (const auto bundle = absolute(options.bundle);
      chosen && !bundle.empty() && (bundle == absolute(options.source) || bundle == absolute(options.sign)))
    return report_error({"the bundle would be written over an input", options.bundle, {}}, exit_usage);
  if (auto key = reports.sign_with(options.sign); !key) return report_error(key.error(), exit_usage);
  if (!chosen) {
    reports.write_left(source->run);
  } else {
    // What the run kept of its inputs and frames, if it was asked for a bundle itself.
    const auto& kept = source->reports;
    if (reports.has_bundle()) {
      auto inputs = inputs_in(kept.bundle, source->run);
      reports.take(inputs ? std::move(*inputs) : inputs_of(source->run, source->profile, source->eds));
    }
    reports.write_others(source->run, {kept.capture, RunBundle(kept.bundle).frames(), kept.bundle});
  }
  if (!options.quiet)
    print(reports::summary(source->run, {use_colour(options.color, 1), terminal_width(), 0}));
  return result::exit_code(source->run);
}

}  // namespace conform::cli
