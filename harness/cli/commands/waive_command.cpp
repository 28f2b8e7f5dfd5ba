// SPDX-License-Identifier: Apache-2.0
// `waive`: a failure of a run becomes an entry in a file of waivers.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include "base/files.hpp"
#include "base/text.hpp"
#include "cli/commands/commands.hpp"
#include "cli/run/run_source.hpp"
#include "cli/run/terminal.hpp"
#include "device/waiver.hpp"
#include "engine/waivers.hpp"
#include "reports/text_tools.hpp"
#include "result/run_json.hpp"

namespace conform::cli {
namespace {

constexpr std::uint64_t largest = std::uint64_t{1} << 20U;

/// The cases of the run whose failure it would cover.
std::vector<std::string> covered(const result::RunResult& run, const device::Waiver& waiver) {
  std::vector<std::string> out;
  for (const auto& one : run.cases) {
    const bool failed = std::ranges::any_of(one.judgements, [&](const result::Judgement& judgement) {
      return judgement.verdict == result::Verdict::fail &&
             engine::covers(waiver, waiver.requirement, one, judgement);
    });
    if (failed) out.push_back(one.name());
  }
  return out;
}

/// What did fail, as a hint.
std::string failed_requirements(const result::RunResult& run) {
  std::set<std::string> ids;
  for (const auto& one : run.cases) {
    for (const auto& judgement : one.judgements) {
      if (judgement.verdict == result::Verdict::fail) ids.insert(reports::log_safe(judgement.requirement));
    }
  }
  constexpr std::size_t most = 8;
  const std::vector<std::string> all(ids.begin(), ids.end());
  if (all.empty()) return "nothing failed in that run";
  std::vector<std::string> shown(all.begin(),
                                 all.begin() + static_cast<std::ptrdiff_t>(std::min(most, all.size())));
  return "failed: " + join(shown, ", ") + (all.size() > most ? ", ..." : "");
}

/// In double quotes, which YAML reads as JSON does.
std::string quoted(const std::string& text) { return result::Json(text).dump(); }

std::string entry(const WaiveCommand& options, const std::optional<Index>& object) {
  std::string out = "  - requirement: " + quoted(options.requirement) + "\n";
  const auto add = [&out](std::string_view key, const std::string& value) {
    if (!value.empty()) out += fmt::format("    {}: {}\n", key, quoted(value));
  };
  add("case", options.case_name);
  if (object) out += "    object: " + to_string(*object) + "\n";
  add("reason", options.reason);
  add("owner", options.owner);
  add("ticket", options.ticket);
  add("expires", options.expires);
  return out;
}

}  // namespace

int waive_command(const WaiveCommand& options) {
  const auto refuse = [](const Error& error) { return report_error(error, exit_usage); };
  std::optional<Index> object;
  if (!options.object.empty()) {
    const auto parsed = parse_multiplexer(options.object);
    if (!parsed) return refuse({"'" + options.object + "' is no object", {}, "write it as 1014h"});
    object = parsed->index;
  }
  if (!options.expires.empty() && !device::parse_date(options.expires))
    return refuse({"'" + options.expires + "' is no date", {}, "write year, month and day as 2027-03-31"});
  for (const auto* text : {&options.reason, &options.owner, &options.ticket}) {
    if (printable(*text) != *text) return refuse({"a text of a waiver must be printable", {}, {}});
  }
  const auto source = read_run(options.result);
  if (!source) return refuse(source.error());
  device::Waiver waiver;
  waiver.requirement = options.requirement;
  waiver.case_name = options.case_name;
  waiver.object = object;
  const auto cases = covered(source->run, waiver);
  if (cases.empty())
    return refuse({"no failure of the run is covered: " + options.requirement, options.result,
                   failed_requirements(source->run)});

  std::string text = "format: 1\nwaivers:\n";
  std::error_code ignored;
  if (std::filesystem::exists(options.file, ignored)) {
    const auto before = device::load_waiver_file(options.file);
    if (!before) return refuse(before.error());
    if (before->diagnostics.has_errors())
      return refuse(
          {"the file of waivers has mistakes:\n" + before->diagnostics.render(false), options.file, {}});
    for (const auto& each : before->waivers) {
      if (each.requirement == options.requirement && each.case_name == options.case_name &&
          each.object == object)
        return refuse({options.requirement + " is waived already", each.place, {}});
    }
    auto content = read_file(options.file, largest);
    if (!content) return refuse(content.error());
    text = std::move(*content);
    if (!text.ends_with('\n')) text += '\n';
  }
  text += entry(options, object);
  if (auto written = write_file_atomically(options.file, text); !written)
    return report_error(written.error(), exit_environment);
  // Somebody may have written the list in a way to which no line can be added.
  const auto after = device::load_waiver_file(options.file);
  if (!after || after->diagnostics.has_errors())
    return report_error({"the entry was added, but the file cannot be read any more", options.file,
                         "the list must be a block list behind 'waivers:', at the end of the file"},
                        exit_usage);
  print(fmt::format("{}: {} waived in {}\n", options.file, reports::log_safe(options.requirement),
                    reports::counted(cases.size(), "case")));
  return 0;
}

}  // namespace conform::cli
