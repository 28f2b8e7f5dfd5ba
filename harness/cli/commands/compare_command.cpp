// SPDX-License-Identifier: Apache-2.0
// `compare`: what is different between two runs.
#include <filesystem>
#include <system_error>

#include "base/files.hpp"
#include "cli/commands/commands.hpp"
#include "cli/run/run_source.hpp"
#include "cli/run/terminal.hpp"
#include "reports/compare.hpp"

namespace conform::cli {

int compare_command(const CompareCommand& options) {
  const auto before = read_run_to_compare(options.before);
  if (!before) return report_error(before.error(), exit_usage);
  const auto after = read_run_to_compare(options.after);
  if (!after) return report_error(after.error(), exit_usage);
  if (!options.html.empty()) {
    for (const auto& input : {options.before, options.after}) {
      std::error_code none;  // it need not be there yet
      if (std::filesystem::equivalent(input, options.html, none))
        return report_error({"the page would be written over what is compared", options.html, {}},
                            exit_usage);
    }
  }
  const auto comparison = result::compare(*before, *after);
  const reports::CompareOptions how{options.strict, options.before, options.after};
  if (!options.html.empty()) {
    const auto written = write_file_atomically(options.html, reports::compare_html(comparison, how));
    if (!written) return report_error(written.error(), exit_environment);
  }
  if (options.format == "json") {
    print(reports::compare_json(comparison, how));
  } else if (options.format == "markdown") {
    print(reports::compare_markdown(comparison, how));
  } else {
    print(reports::compare_text(comparison, how, {use_colour(options.color, 1), terminal_width(), 0}));
  }
  return result::exit_code(comparison, options.strict);
}

}  // namespace conform::cli
