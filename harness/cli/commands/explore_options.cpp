// SPDX-License-Identifier: Apache-2.0
#include "cli/commands/explore_options.hpp"

namespace conform::cli {

CLI::App* add_explore(CLI::App& app, ExploreCommand& command) {
  auto* sub = app.add_subcommand(
      "explore", "Look for what no scenario asks for: random conversations, held against a conformant model");
  auto* interface =
      sub->add_option("-i,--interface", command.interface,
                      "CAN interface the device is alone on with this program, for example can0")
          ->type_name("NAME");
  auto* simulate =
      sub->add_flag("--simulate", command.simulate, "Explore the reference node on a simulated bus")
          ->excludes(interface);
  sub->add_option(
         "--allow", command.allow,
         "Highest risk to take: config, nvm or motion (default: config on real interfaces, motion on virtual ones)")
      ->check(CLI::IsMember({"config", "nvm", "motion"}).description(""))
      ->type_name("RISK");
  sub->add_option(
         "--journal", command.journal,
         "Keep the journal here (default: ~/.local/state/canopen-conform, for each interface and node)")
      ->type_name("FILE");
  sub->add_option("--defect", command.defects,
                  "Defect to switch on in the simulated node; repeatable (canopen-refnode --list-defects)")
      ->allow_extra_args(false)
      ->type_name("ID");
  sub->add_option(
         "--variant", command.variants,
         "Legal variant of the simulated node, and of its model; repeatable (canopen-refnode --list-variants)")
      ->allow_extra_args(false)
      ->type_name("ID");
  sub->add_option("-n,--node", command.node, "Node-ID of the device, 1 to 127")
      ->check(CLI::Range(1, 127).description(""))
      ->type_name("NODE-ID");
  sub->add_option("-d,--device", command.device, "Device profile (YAML): claims, error triggers")
      ->type_name("FILE");
  sub->add_option("--eds", command.eds, "Description of the device: node and model are its twins")
      ->type_name("FILE");
  sub->add_option("--seed", command.seed, "Seed of the conversations (default 1)")->type_name("NUMBER");
  sub->add_option("--for", command.time,
                  "End after this time, 10s or 2 min (default 10s, on an interface 60s)")
      ->type_name("TIME");
  sub->add_option("--actions", command.actions,
                  "End after so many actions: the same on every machine, also with what --for would cut off")
      ->type_name("NUMBER");
  sub->add_option("--findings", command.most_findings, "End after so many findings (default 20)")
      ->type_name("NUMBER");
  sub->add_option("--write", command.write, "Write the findings as scenarios")->type_name("FILE");
  sub->add_option("--corpus", command.corpus,
                  "Begin with the conversations kept here, and keep those that come to a new state")
      ->needs(simulate)
      ->type_name("FOLDER");
  sub->add_flag("--strict", command.strict, "Exit with 3 for what is tolerated or has no known rule, too");
  sub->add_flag("-q,--quiet", command.quiet, "Print only the summary");
  auto* prove = sub->add_flag(
      "--prove", command.prove,
      "What is found of each defect of the reference node (or those of --defect and --variant), "
      "and whether legal variants are blamed; --actions for each (default 20000)");
  sub->add_option(
         "--combinations", command.combinations,
         "With --prove: whether this many random combinations of legal variants are blamed, and nothing else")
      ->type_name("NUMBER")
      ->needs(prove);
  sub->add_option("--mutant", command.mutants,
                  "With --prove: only this mutant, room or file, or 'open': those that the suite is known to "
                  "miss; repeatable (canopen-conform-mutants only)")
      ->allow_extra_args(false)
      ->type_name("WHICH")
      ->needs(prove);
  sub->add_flag("-v,--verbose", command.verbose, "With --prove: what was named instead")->needs(prove);
  sub->add_option("-j,--jobs", command.jobs, "With --prove: threads (default: the machine's cores)")
      ->check(CLI::Range(1, 256))
      ->needs(prove)
      ->type_name("NUMBER");
  return sub;
}

}  // namespace conform::cli
