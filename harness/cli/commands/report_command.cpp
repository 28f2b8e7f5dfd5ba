// SPDX-License-Identifier: Apache-2.0
// `report`: the reports of a run anew, from its journal.
#include "cli/commands/commands.hpp"
#include "cli/run/run_reports.hpp"
#include "cli/run/terminal.hpp"
#include "journal/reader.hpp"
#include "reports/console.hpp"

namespace conform::cli {

int report_command(const ReportCommand& options) {
  auto journal = journal::read(options.journal);
  if (!journal) return report_error(journal.error(), exit_usage);
  const bool chosen = !options.junit.empty() || !options.markdown.empty() || !options.capture.empty();
  RunReports reports(chosen ? journal::ReportPaths{absolute(options.junit),
                                                   absolute(options.markdown),
                                                   absolute(options.capture),
                                                   {}}
                            : journal->header.reports);
  reports.write_left(journal->run);
  if (!options.quiet)
    print(reports::summary(journal->run, {use_colour(options.color, 1), terminal_width(), 0}));
  return result::exit_code(journal->run);
}

}  // namespace conform::cli
