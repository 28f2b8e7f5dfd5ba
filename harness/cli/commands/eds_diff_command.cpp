// SPDX-License-Identifier: Apache-2.0
// `eds diff`: what two descriptions say differently, of whatever formats they are.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "base/text.hpp"
#include "cli/commands/commands.hpp"
#include "cli/run/terminal.hpp"
#include "eds/compare.hpp"
#include "eds/read.hpp"

namespace conform::cli {
namespace {

using Json = nlohmann::ordered_json;
using Differences = std::vector<eds::Difference>;

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

std::string lines(const Differences& differences, std::string_view margin) {
  const auto shown = [](const std::string& value) {
    return value.empty() ? std::string("(none)") : printable(value);
  };
  std::string out;
  for (const auto& each : differences) {
    out += fmt::format("{}{} {}", margin, sign(each.kind), each.where);
    if (!each.name.empty()) out += " " + printable(each.name);
    if (!each.key.empty())
      out += fmt::format(": {} {} -> {}", each.key, shown(each.before), shown(each.after));
    out += "\n";
  }
  return out;
}

std::string counted(std::size_t count) {
  return fmt::format("{} difference{}", count == 0 ? "no" : std::to_string(count), count == 1 ? "" : "s");
}

std::string text_of(const EdsDiffCommand& options, const eds::Comparison& found) {
  std::string out = lines(found.of_device, "");
  if (options.file_info) out += lines(found.of_file, "");
  if (!found.unsayable.empty())
    out += "not counted, one of the formats cannot say it:\n" + lines(found.unsayable, "  ");
  out += counted(found.of_device.size() + (options.file_info ? found.of_file.size() : 0));
  if (!options.file_info && !found.of_file.empty())
    out += fmt::format(", and {} in what only describes the file (--file-info)", found.of_file.size());
  return out + "\n";
}

Json json_of(const Differences& differences) {
  Json out = Json::array();
  for (const auto& each : differences) {
    out.push_back({{"kind", std::string(word(each.kind))},
                   {"where", each.where},
                   {"name", printable(each.name)},
                   {"key", each.key},
                   {"before", printable(each.before)},
                   {"after", printable(each.after)},
                   {"line_before", each.at_before.line},
                   {"line_after", each.at_after.line}});
  }
  return out;
}

std::string json_of(const EdsDiffCommand& options, const eds::Comparison& found) {
  Json out;
  out["schema"] = "canopen-conform/eds-diff/1";
  out["before"] = printable(options.before);
  out["after"] = printable(options.after);
  out["differences"] = json_of(found.of_device);
  out["of_file"] = json_of(found.of_file);
  out["unsayable"] = json_of(found.unsayable);
  return out.dump(2) + "\n";
}

}  // namespace

int eds_diff_command(const EdsDiffCommand& options) {
  const auto before = eds::read_file(options.before);
  if (!before) return report_error(before.error(), exit_usage);
  const auto after = eds::read_file(options.after);
  if (!after) return report_error(after.error(), exit_usage);
  const auto found = eds::compare_in_full(*before, *after);
  if (!found) return report_error(found.error(), exit_usage);
  print(options.format == "json" ? json_of(options, *found) : text_of(options, *found));
  return found->of_device.empty() && (!options.file_info || found->of_file.empty()) ? 0 : 1;
}

}  // namespace conform::cli
