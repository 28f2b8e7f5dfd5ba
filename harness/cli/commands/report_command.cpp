// SPDX-License-Identifier: Apache-2.0
// `report`: the reports of a run anew, from what it found (result.json) or from its journal; of several,
// joined.
#include "cli/commands/commands.hpp"
#include "cli/run/run_reports.hpp"
#include "cli/run/run_source.hpp"
#include "cli/run/several.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "reports/console.hpp"

namespace conform::cli {
namespace {

/// Several runs as they lie on the disk, each under its name, and with its page where that lies beside it.
Result<std::vector<result::NamedRun>> runs_of(const std::vector<std::string>& sources) {
  std::vector<result::NamedRun> out;
  for (const auto& path : sources) {
    auto source = read_run_with_cases(path);
    if (!source) return std::unexpected(source.error());
    const auto own = source->reports.reports.find("html");
    auto page =
        page_of(source->run, pages_beside(path, own == source->reports.reports.end() ? "" : own->second));
    out.push_back({path, std::move(source->run), std::move(page)});
  }
  return out;
}

/// What is to be written of several devices at once. Error: it tells of one device.
Result<void> only_of_several(const ReportCommand& options) {
  const auto of_one = [](const std::string& option) {
    return fail("several devices cannot be in one file of --" + option, {},
                "of several: --html, --markdown, --csv and --junit; the others of each result by itself");
  };
  for (const auto& [format, path] : options.reports) {
    if (!path.empty() && !is_of_several(format)) return of_one(format);
  }
  if (!options.bundle.empty()) return of_one("bundle");
  return {};
}

/// The captures of parts and of other devices are other files.
Result<void> without_frames(const ReportCommand& options) {
  if (options.capture.empty() && options.captures.empty()) return {};
  return fail("--capture is of one run, and --merge joins several", {},
              "comment the capture of each by itself");
}

int report_run(const ReportCommand& options, RunSource source) {
  auto paths = absolute_paths(
      options.reports, {.capture = options.capture, .captures = options.captures, .bundle = options.bundle});
  const bool chosen =
      !paths.reports.empty() || !paths.capture.empty() || !paths.captures.empty() || !paths.bundle.empty();
  RunReports reports(chosen ? std::move(paths) : source.reports);
  if (auto apart = reports.captures_apart(); !apart) return report_error(apart.error(), exit_usage);
  if (const auto bundle = absolute(options.bundle);
      chosen && !bundle.empty() &&
      (bundle == absolute(options.sources.front()) || bundle == absolute(options.sign)))
    return report_error({"the bundle would be written over an input", options.bundle, {}}, exit_usage);
  if (auto key = reports.sign_with(options.sign); !key) return report_error(key.error(), exit_usage);
  if (!chosen) {
    reports.write_left(source.run);
  } else {
    // What the run kept of its inputs and frames, if it was asked for a bundle itself.
    const auto& kept = source.reports;
    if (reports.has_bundle()) {
      auto inputs = inputs_in(kept.bundle, source.run);
      reports.take(inputs ? std::move(*inputs) : inputs_of(source.run, source.profile, source.eds));
    }
    reports.write_others(source.run, {kept.capture, RunBundle(kept.bundle).frames(), kept.bundle});
  }
  if (!options.quiet)
    print(reports::summary(source.run, {use_colour(options.color, 1), terminal_width(), 0}));
  return result::exit_code(source.run);
}

}  // namespace

int report_command(const ReportCommand& options) {
  if (options.sources.size() > 1 && !options.merge)
    return report_error({"several results", options.sources[1], "--merge joins them"}, exit_usage);
  if (!options.merge) {
    auto source = read_run(options.sources.front());
    if (!source) return report_error(source.error(), exit_usage);
    return report_run(options, std::move(*source));
  }
  if (auto sound = without_frames(options); !sound) return report_error(sound.error(), exit_usage);
  auto runs = runs_of(options.sources);
  if (!runs) return report_error(runs.error(), exit_usage);
  auto devices = devices_of(std::move(*runs));
  if (!devices) return report_error(devices.error(), exit_usage);
  if (devices->size() > 1) {
    if (auto sound = only_of_several(options); !sound) return report_error(sound.error(), exit_usage);
    return report_devices(*devices, options.reports, options.quiet, options.color);
  }
  // A run that was whole before keeps what it said; one that was put together is looked at as a whole.
  RunSource whole{.run = std::move(devices->front().run)};
  if (const auto root = find_suites(std::string()); root && whole.run.likenesses.empty())
    name_known_mistakes(whole.run, *root);
  return report_run(options, std::move(whole));
}

}  // namespace conform::cli
