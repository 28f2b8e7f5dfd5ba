// SPDX-License-Identifier: Apache-2.0
// `eds lint`, `eds show`: device descriptions without a device.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/files.hpp"
#include "base/text.hpp"
#include "cli/commands/commands.hpp"
#include "cli/descriptions/eds_formats.hpp"
#include "cli/descriptions/eds_page.hpp"
#include "cli/descriptions/eds_table.hpp"
#include "cli/run/terminal.hpp"
#include "eds/expand.hpp"
#include "eds/ini_file.hpp"
#include "eds/read.hpp"

namespace conform::cli {
namespace {

EdsLinted lint_file(const std::string& path) {
  EdsLinted out;
  out.file = path;
  auto bytes = read_file(path, eds::IniFile::most_bytes);
  if (!bytes) {
    out.unreadable = bytes.error();
    return out;
  }
  const auto file = eds::read(*bytes, path);
  if (!file) {
    out.unreadable = file.error();
    return out;
  }
  out.bytes = std::move(*bytes);
  out.kind = std::string(to_string(file->format));
  out.report = eds::lint(*file);
  return out;
}

}  // namespace

int eds_lint_command(const EdsLintCommand& options) {
  if (options.rules) {
    print(eds::lint_table_markdown());
    return 0;
  }
  if (options.files.empty())
    return report_error({"no file is named", {}, "canopen-conform eds lint FILE..."}, exit_usage);
  std::vector<EdsLinted> files;
  for (const auto& file : options.files) files.push_back(lint_file(file));
  if (options.format == "json")
    print(eds_lint_json(files));
  else if (options.format == "github")
    print(eds_lint_github(files));
  else if (options.format == "sarif")
    print(eds_lint_sarif(files));
  else
    print(eds_lint_text(files, use_colour(options.color, 1)));
  bool wrong = false;
  for (const auto& file : files) {
    if (file.unreadable) (void)report_error(*file.unreadable, exit_usage);
    wrong = wrong || file.unreadable || file.report.count(eds::Severity::error) > 0 ||
            (options.strict && file.report.count(eds::Severity::warning) > 0);
  }
  return wrong ? exit_usage : 0;
}

int eds_show_command(const EdsShowCommand& options) {
  const auto file = eds::read_file(options.file);
  if (!file) return report_error(file.error(), exit_usage);
  const auto objects = eds::expand(*file);
  if (!objects) return report_error(objects.error(), exit_usage);
  if (!options.html.empty()) {
    const auto written = write_file_atomically(options.html, eds_page(*file, *objects, eds::lint(*file)));
    return written ? 0 : report_error(written.error(), exit_usage);
  }
  print(options.format == "json" ? eds_json(*file, *objects) : eds_table(*file, *objects));
  return 0;
}

}  // namespace conform::cli
