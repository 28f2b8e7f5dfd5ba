// SPDX-License-Identifier: Apache-2.0
// `report`: the reports of a run anew, from what it found (result.json) or from its journal.
#include "cli/commands/commands.hpp"
#include "cli/run/cause_captures.hpp"
#include "cli/run/run_reports.hpp"
#include "cli/run/run_source.hpp"
#include "cli/run/terminal.hpp"
#include "reports/console.hpp"

namespace conform::cli {

int report_command(const ReportCommand& options) {
  auto source = read_run(options.source);
  if (!source) return report_error(source.error(), exit_usage);
  if (!options.captures.empty() && options.capture.empty()) {
    return report_error({"the captures of the causes are made from the capture of the run", options.captures,
                         "--capture FILE says where that is"},
                        exit_usage);
  }
  if (!options.captures.empty()) {
    if (auto emptied = empty_capture_folder(absolute(options.captures)); !emptied)
      return report_error(emptied.error(), exit_environment);
  }
  auto paths = absolute_paths(options.reports, options.capture, {}, options.captures);
  const bool chosen = !paths.reports.empty() || !paths.capture.empty();
  RunReports reports(chosen ? std::move(paths) : std::move(source->reports));
  reports.write_left(source->run);
  if (!options.quiet)
    print(reports::summary(source->run, {use_colour(options.color, 1), terminal_width(), 0}));
  return result::exit_code(source->run);
}

}  // namespace conform::cli
