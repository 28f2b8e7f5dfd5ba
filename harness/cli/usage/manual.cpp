// SPDX-License-Identifier: Apache-2.0
#include "cli/usage/manual.hpp"

#include "cli/run/settings.hpp"
#include "usage/model.hpp"

namespace conform::cli {
namespace {

bool has_option(CLI::App& command, const char* name) { return command.get_option_no_throw(name) != nullptr; }

/// The options of a run are variables, too; the others read only what is common.
std::vector<usage::Entry> environment(CLI::App& command) {
  std::vector<usage::Entry> out;
  const bool whole = command.get_parent() == nullptr;
  const auto path = usage::path_of(command);
  if (path == "run") {
    const auto add = [&out](const CLI::Option& option) {
      const auto name = usage::name_of(option);
      if (name == "--help" || name == "--show-config") return;
      const bool named = name.starts_with("--");
      const auto words = usage::is_repeatable(option) ? ", with commas between several" : "";
      out.push_back({variable_of(named ? name.substr(2) : name),
                     (named ? "as " + name : "as the arguments " + usage::type_of(option)) + words});
    };
    for (const auto* option : usage::options_of(command)) add(*option);
    for (const auto* argument : usage::arguments_of(command)) add(*argument);
  }
  if (whole)
    out.push_back({"CANOPEN_CONFORM_OPTION",
                   "in the place of an option of 'run' that the command line does not have; 'run "
                   "--show-config' tells what comes from where"});
  if (whole || has_option(command, "--suites"))
    out.push_back({"CANOPEN_CONFORM_SUITES",
                   "folder of a set of suites that is used in the place of the installed one"});
  if (whole || has_option(command, "--color"))
    out.push_back({"NO_COLOR", "whatever its value: no colours, unless --color says otherwise"});
  if (whole || path == "run" || path == "recover")
    out.push_back({"XDG_STATE_HOME", "where journals are kept, in the place of ~/.local/state"});
  return out;
}

usage::CommandPage program_page() {
  return {
      "",
      {{"canopen-conform run --simulate", "the whole suite against the reference node, without any device"},
       {"canopen-conform doctor --interface can0 --ask", "who is there; of a dead bus why, and what to type"},
       {"canopen-conform run --interface can0 --node 5 --html report.html",
        "a device, read only, with a report for people"},
       {"canopen-conform explain OD-1003-06", "a requirement: the rule, its clause, what passes and fails"}},
      {{"0", "everything planned was judged and nothing failed"},
       {"1", "at least one requirement failed"},
       {"2", "usage, a mistake in a scenario or profile, nothing selected or nothing applicable"},
       {"3", "no failure, but the environment failed or something was inconclusive"},
       {"130, 143", "ended by SIGINT, SIGTERM; values are put back and the reports are written"}},
      {"canopen-conform drives a CANopen device over Linux SocketCAN through scenarios written in YAML and "
       "says, requirement by requirement, whether it conforms to CiA 301. On a real interface it only reads "
       "unless --allow says more.",
       "Exit codes are those of 'run' and of all that judges; the page of each command tells its own."}};
}

}  // namespace

usage::Manual manual() {
  usage::Manual out{
      .program = "canopen-conform",
      .summary = "conformance tests for CANopen devices (CiA 301)",
      .pages = {program_page()},
      .files =
          {{"/usr/share/canopen-conform/suites", "scenarios, requirements, profiles and schemas"},
           {"~/.local/state/canopen-conform",
            "journals of runs, from which 'canopen-conform recover' puts back what a killed run left in a "
            "device"},
           {"device.yaml",
            "device profile: of the working folder, where the command line of 'run' names no device"},
           {"waivers.yaml", "failures that are accepted, beside the device profile"},
           {".canopen-conform.yaml", "what 'eds lint' is told about descriptions in its folder and below"}},
      .see_also = {"canopen-refnode"},
      .environment = environment};
  for (auto& page : device_pages()) out.pages.push_back(std::move(page));
  for (auto& page : other_pages()) out.pages.push_back(std::move(page));
  return out;
}

}  // namespace conform::cli
