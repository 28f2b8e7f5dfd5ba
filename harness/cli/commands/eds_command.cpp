// SPDX-License-Identifier: Apache-2.0
// `eds lint`, `eds show`, `eds diff`: device descriptions without a device.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/files.hpp"
#include "base/text.hpp"
#include "cli/commands/commands.hpp"
#include "cli/descriptions/eds_formats.hpp"
#include "cli/descriptions/eds_table.hpp"
#include "cli/run/terminal.hpp"
#include "eds/compare.hpp"
#include "eds/expand.hpp"
#include "eds/ini_file.hpp"
#include "eds/read.hpp"

namespace conform::cli {
namespace {

using Json = nlohmann::ordered_json;

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

std::string_view sign(eds::Difference::Kind kind) {
  switch (kind) {
    case eds::Difference::Kind::added: return "+";
    case eds::Difference::Kind::removed: return "-";
    case eds::Difference::Kind::changed: return "~";
  }
  return "~";
}

std::string_view word(eds::Difference::Kind kind) {
  switch (kind) {
    case eds::Difference::Kind::added: return "added";
    case eds::Difference::Kind::removed: return "removed";
    case eds::Difference::Kind::changed: return "changed";
  }
  return "changed";
}

std::string diff_text(const std::vector<eds::Difference>& differences) {
  const auto shown = [](const std::string& value) {
    return value.empty() ? std::string("(none)") : printable(value);
  };
  std::string out;
  for (const auto& each : differences) {
    out += fmt::format("{} {}", sign(each.kind), each.where);
    if (!each.name.empty()) out += " " + printable(each.name);
    if (!each.key.empty())
      out += fmt::format(": {} {} -> {}", each.key, shown(each.before), shown(each.after));
    out += "\n";
  }
  return out + fmt::format("{} difference{}\n",
                           differences.empty() ? "no" : std::to_string(differences.size()),
                           differences.size() == 1 ? "" : "s");
}

std::string diff_json(const EdsDiffCommand& options, const std::vector<eds::Difference>& differences) {
  Json out;
  out["schema"] = "canopen-conform/eds-diff/1";
  out["before"] = printable(options.before);
  out["after"] = printable(options.after);
  out["differences"] = Json::array();
  for (const auto& each : differences) {
    out["differences"].push_back({{"kind", std::string(word(each.kind))},
                                  {"where", each.where},
                                  {"name", printable(each.name)},
                                  {"key", each.key},
                                  {"before", printable(each.before)},
                                  {"after", printable(each.after)},
                                  {"line_before", each.at_before.line},
                                  {"line_after", each.at_after.line}});
  }
  return out.dump(2) + "\n";
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
  print(options.format == "json" ? eds_json(*file, *objects) : eds_table(*file, *objects));
  return 0;
}

int eds_diff_command(const EdsDiffCommand& options) {
  const auto before = eds::read_file(options.before);
  if (!before) return report_error(before.error(), exit_usage);
  const auto after = eds::read_file(options.after);
  if (!after) return report_error(after.error(), exit_usage);
  const auto differences = eds::compare(*before, *after);
  if (!differences) return report_error(differences.error(), exit_usage);
  print(options.format == "json" ? diff_json(options, *differences) : diff_text(*differences));
  return differences->empty() ? 0 : 1;
}

}  // namespace conform::cli
