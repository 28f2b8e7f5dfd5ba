// SPDX-License-Identifier: Apache-2.0
// `report`: the reports of a run anew, from what it found (result.json) or from its journal.
#include "base/files.hpp"
#include "cli/commands/commands.hpp"
#include "cli/run/run_reports.hpp"
#include "cli/run/terminal.hpp"
#include "journal/reader.hpp"
#include "reports/console.hpp"
#include "reports/result_json.hpp"

namespace conform::cli {
namespace {

constexpr std::uint64_t largest = std::uint64_t{4} << 30U;

/// A run, and where its own reports are; a result does not know that.
struct Source {
  result::RunResult run;
  journal::ReportPaths reports;
};

Result<Source> read(const std::string& path) {
  auto text = read_file(path, largest);
  if (!text) return std::unexpected(text.error());
  if (reports::is_result_json(*text)) {
    auto run = reports::read_result_json(*text, path);
    if (!run) return std::unexpected(run.error());
    return Source{std::move(*run), {}};
  }
  auto journal = journal::read(path);
  if (!journal) return std::unexpected(journal.error());
  return Source{std::move(journal->run), std::move(journal->header.reports)};
}

}  // namespace

int report_command(const ReportCommand& options) {
  auto source = read(options.source);
  if (!source) return report_error(source.error(), exit_usage);
  auto paths = absolute_paths(options.reports, options.capture, {});
  const bool chosen = !paths.reports.empty() || !paths.capture.empty();
  RunReports reports(chosen ? std::move(paths) : std::move(source->reports));
  reports.write_left(source->run);
  if (!options.quiet)
    print(reports::summary(source->run, {use_colour(options.color, 1), terminal_width(), 0}));
  return result::exit_code(source->run);
}

}  // namespace conform::cli
