// SPDX-License-Identifier: Apache-2.0
#include "cli/commands/run_options.hpp"

#include <cstdio>

#include "base/text.hpp"
#include "cli/commands/common_options.hpp"
#include "cli/run/terminal.hpp"

namespace conform::cli {
namespace {

/// The mistake in the value of --shuffle; empty: none.
std::string mistake_in_seed(const std::string& word) {
  const bool right = word == "true" || word == "false" || parse_number(word).has_value();
  return right ? std::string() : "'" + word + "' is no number";
}

/// Which cases of a run are played, and how often.
void add_choice(CLI::App& app, Choice& into) {
  app.add_option("--rerun-failed", into.rerun_failed,
                 "Only the cases that failed or were left open in this run (result.json or journal)")
      ->type_name("RESULT|JOURNAL");
  auto* repeat =
      app.add_option("--repeat", into.repeat,
                     "Each case so many times: the worst counts, and how many ended like it is told")
          ->check(CLI::Range(std::size_t{1}, std::size_t{1000000}).description(""))
          ->type_name("NUMBER");
  app.add_flag("--until-fail", into.until_fail, "A case that has failed is not repeated any more")
      ->needs(repeat);
  app.add_flag("--fail-fast", into.fail_fast, "The first case that fails is the last one");
  app.add_option(
         "--budget", into.budget,
         "Play first what finds the most in the least time, and leave out what would not end within this time")
      ->type_name("TIME")
      ->excludes(app.get_option("--shuffle"))
      ->excludes(app.get_option("--cct"));
  app.add_option("--shard", into.shard,
                 "One of several parts of the run, to be played at the same time: 2/5 is the second of five")
      ->type_name("K/N");
}

}  // namespace

void RunOptions::add_to(CLI::App& app) {
  app.add_option("select", command.select, "Scenarios: ids or leading paths, * and ? allowed (default: all)")
      ->type_name("ID");
  app.add_option("-i,--interface", command.interface, "CAN interface the device is on, for example can0")
      ->type_name("NAME");
  app.add_flag("--simulate", command.simulate,
               "Run against the reference node on a simulated bus, without any device");
  app.add_option("--variant", command.variants,
                 "Legal variant of the simulated node; repeatable (canopen-refnode --list-variants)")
      ->allow_extra_args(false)
      ->type_name("ID");
  app.add_option("--defect", command.defects,
                 "Defect to switch on in the simulated node; repeatable (canopen-refnode --list-defects)")
      ->allow_extra_args(false)
      ->type_name("ID");
  auto* node = app.add_option("-n,--node", command.node, "Node-ID of the device, 1 to 127")
                   ->check(CLI::Range(1, 127).description(""))
                   ->type_name("NODE-ID");
  app.add_option(
         "--nodes", command.nodes,
         "Several devices of one bus, one after the other: 5,6,7. Reports for each (report.node5.html) and for all")
      ->check(CLI::Range(1, 127).description(""))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NODE-IDS")
      ->excludes(node);
  app.add_option("-d,--device", command.device, "Device profile (YAML): claims, error triggers, tolerances")
      ->type_name("FILE");
  app.add_option(
         "--eds", command.eds,
         "Description of the device (EDS, DCF, XDD, XDC): what it claims is expected; with --simulate the node is its twin")
      ->type_name("FILE");
  app.add_option("-r,--requirement", command.requirements,
                 "Only scenarios that decide this requirement (* allowed); repeatable")
      ->allow_extra_args(false)
      ->type_name("ID");
  app.add_option("-x,--exclude", command.exclude, "Leave out these scenarios (* and ? allowed); repeatable")
      ->allow_extra_args(false)
      ->type_name("ID");
  app.add_option(
         "--allow", command.allow,
         "Highest risk to take: read-only, config, nvm or motion (default: read-only on real interfaces, motion on virtual ones)")
      ->type_name("RISK");
  add_waivers(app, command.waivers);
  add_reports(app, command.reports);
  app.add_option("--capture", command.capture, "Write all frames as pcapng, for Wireshark, while they come")
      ->type_name("FILE");
  app.add_option(
         "--captures", command.captures,
         "Folder for one pcapng per cause, with the frames of its first case; earlier ones are removed")
      ->type_name("FOLDER");
  app.add_option("--candump", command.candump,
                 "Write all frames as candump log, for can-utils, while they come")
      ->type_name("FILE");
  add_bundle(app, command.bundle, command.sign);
  app.add_option(
         "--journal", command.journal,
         "Keep the journal here (default: ~/.local/state/canopen-conform, for each interface and node)")
      ->type_name("FILE");
  app.add_option("--baseline", command.baseline,
                 "Compare with this run (result.json or journal): only what is new makes the exit code 1")
      ->type_name("RESULT|JOURNAL");
  app.add_flag("--dry-run", command.dry_run, "Only list what would run; send nothing");
  app.add_flag(
      "--strict", command.strict,
      "Every deviation from a recommended or optional rule fails, also one that is tolerated otherwise");
  app.add_flag("--all-objects", command.all_objects, "Try every object where a scenario would try a sample");
  auto* cct =
      app.add_flag("--cct", command.cct,
                   "Only what corresponds to the cases of CiA's tool, in its order, and what it would say");
  app.add_flag(
         "--shuffle", command.shuffle,
         "The cases in a random order, drawn by --seed (or --shuffle=NUMBER): no verdict may depend on it")
      ->check(CLI::Validator([](const std::string& word) { return mistake_in_seed(word); }, ""))
      ->excludes(cct);
  add_choice(app, command.choice);
  app.add_flag("--annotate", command.annotate, "Print the causes as annotations for GitHub Actions, too");
  app.add_option("--wait-for-bus", command.wait_for_bus,
                 "How long to wait for a bus that goes away in the middle of the run (default 10 s)")
      ->type_name("TIME");
  app.add_option(
         "--timeout-scale", command.timeout_scale,
         "Every time that the profile allows the device is so many times as long, for a slow one (default 1)")
      ->check(CLI::Range(1.0, 100.0).description(""))
      ->type_name("FACTOR");
  app.add_flag("--slow", command.slow, "Also what takes minutes on a real bus (always in simulation)");
  app.add_option("--seed", command.seed, "Seed of samples and of the simulation (default 1)")
      ->type_name("NUMBER");
  app.add_flag("-q,--quiet", command.quiet, "Print only what did not pass, and the summary");
  app.add_option("--color", command.color, "Colours: auto, always or never")
      ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
      ->type_name("WHEN");
  app.add_option(
         "--suites", command.suites,
         "Folder of own scenarios and requirements, beside those that came with the program; repeatable")
      ->allow_extra_args(false)
      ->type_name("FOLDER");
  app.add_flag("--show-config", show_config_,
               "Only print the value of each option and where it comes from: command line, environment "
               "(CANOPEN_CONFORM_...), profile (run:) or default");
}

int RunOptions::run(const MergedLine& line) const {
  if (show_config_) {
    print(config_table(line));
    return 0;
  }
  if (line.profile_found && !command.quiet)
    std::fprintf(stderr, "canopen-conform: the device profile is %s, found in this folder\n", found_profile);
  return command.nodes.empty() ? run_command(command) : run_nodes(command);
}

}  // namespace conform::cli
