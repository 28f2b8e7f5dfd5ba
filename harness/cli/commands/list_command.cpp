// SPDX-License-Identifier: Apache-2.0
// `list`: scenarios with their requirements and risk.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "cli/commands/commands.hpp"
#include "cli/pages/cct_cases.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "engine/monitor_cases.hpp"
#include "scenario/selection.hpp"

namespace conform::cli {

int list_command(const ListCommand& options) {
  auto root = find_suites(options.suites);
  if (!root) return report_error(root.error(), exit_usage);
  auto suites = load_suites(*root, use_colour("auto", 2));
  if (!suites) return report_error(suites.error(), exit_usage);
  const scenario::Selection selection{options.select, options.requirements, {}};
  if (options.cct) {
    const bool everything = options.select.empty() && options.requirements.empty();
    const auto page = cct_page(suites->suite, suites->catalogue, selection, everything);
    print(page.empty() ? "no case of CiA's tool corresponds\n" : page);
    return page.empty() ? exit_usage : 0;
  }
  std::string out;
  std::size_t shown = 0, watching = 0;
  for (const auto& file : suites->suite.files) {
    bool heading = false;
    for (const auto& each : file.scenarios) {
      if (!selection.takes(each, "", suites->catalogue)) continue;
      if (!heading) out += fmt::format("{}{}\n", out.empty() ? "" : "\n", file.title);
      heading = true;
      ++shown;
      out += fmt::format("  {}  [{}]\n      {}\n      {}\n", each.id, steps::word_of(each.risk), each.title,
                         join(each.requirements, ", "));
      if (!each.cct.empty()) out += "      CCT " + join(each.cct, ", ") + "\n";
    }
  }
  const bool only_named = !options.select.empty() && !engine::names_a_monitor(selection, suites->catalogue);
  if (!only_named) {
    const auto monitors = engine::chosen_monitors(selection, suites->catalogue);
    if (!monitors.empty())
      out += fmt::format("{}Monitors: judge every frame of every run\n", out.empty() ? "" : "\n");
    for (const auto* rule : monitors) {
      const std::vector<std::string> ids(rule->requirements.begin(), rule->requirements.end());
      out += fmt::format("  {}\n      {}\n      {}\n", monitor::case_id(*rule), rule->title, join(ids, ", "));
    }
    watching = monitors.size();
  }
  print(out);
  const auto s = [](std::size_t count) { return count == 1 ? "" : "s"; };
  print(fmt::format("\n{} scenario{}, {} monitor{}\n", shown, s(shown), watching, s(watching)));
  return shown + watching == 0 ? exit_usage : 0;
}

}  // namespace conform::cli
