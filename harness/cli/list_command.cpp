// SPDX-License-Identifier: Apache-2.0
// `list`: scenarios with their requirements and risk.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "cli/commands.hpp"
#include "cli/suite_folder.hpp"
#include "cli/terminal.hpp"
#include "scenario/selection.hpp"

namespace conform::cli {

int list_command(const ListCommand& options) {
  auto root = find_suites(options.suites);
  if (!root) return report_error(root.error(), exit_usage);
  auto suites = load_suites(*root, use_colour("auto", 2));
  if (!suites) return report_error(suites.error(), exit_usage);
  const scenario::Selection selection{options.select, options.requirements, {}};
  std::string out;
  std::size_t shown = 0;
  for (const auto& file : suites->suite.files) {
    bool heading = false;
    for (const auto& each : file.scenarios) {
      if (!selection.takes(each, "", suites->catalogue)) continue;
      if (options.cct && each.cct.empty()) continue;
      if (!heading) out += fmt::format("{}{}\n", out.empty() ? "" : "\n", file.title);
      heading = true;
      ++shown;
      out += fmt::format("  {}  [{}]\n      {}\n      {}\n", each.id, to_string(each.risk), each.title,
                         join(each.requirements, ", "));
      if (!each.cct.empty()) out += "      CCT " + join(each.cct, ", ") + "\n";
    }
  }
  print(out);
  print(fmt::format("\n{} scenarios\n", shown));
  return shown == 0 ? exit_usage : 0;
}

}  // namespace conform::cli
