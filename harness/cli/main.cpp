// SPDX-License-Identifier: Apache-2.0
// Command line of canopen-conform.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "cli/commands/commands.hpp"
#include "cli/commands/common_options.hpp"
#include "cli/commands/eds_options.hpp"
#include "cli/commands/explore_options.hpp"
#include "cli/commands/run_options.hpp"
#include "cli/run/command_line.hpp"
#include "cli/run/guardian.hpp"
#include "cli/run/settings.hpp"
#include "cli/run/terminal.hpp"
#include "cli/usage/known_values.hpp"
#include "cli/usage/manual.hpp"
#include "usage/program.hpp"
#include "usage/shells.hpp"

namespace {

/// Nobody else runs yet.
const char* environment(const std::string& name) {
  return std::getenv(name.c_str());  // NOLINT(concurrency-mt-unsafe)
}

int dispatch(int argc, char** argv) {
  using namespace conform::cli;
  namespace usage = conform::usage;
  CLI::App app{
      "CANopen (CiA 301) conformance harness.\n"
      "Exit codes: 0 conforms, 1 a requirement failed, 2 usage or nothing applicable, 3 environment or inconclusive, 130/143 signal."};
  app.name("canopen-conform");
  app.get_formatter()->column_width(34);
  app.set_version_flag("--version", "canopen-conform " CONFORM_VERSION, "Print the version");
  app.require_subcommand(1);

  RunOptions run;
  auto* run_sub = app.add_subcommand(
      "run", "Run the suite against a device, or against the reference node in simulation");
  run.add_to(*run_sub);

  ReportCommand report;
  auto* report_sub =
      app.add_subcommand("report", "Make the reports of a run anew, from its result.json or its journal");
  report_sub
      ->add_option("source", report.sources,
                   "Result (run --json) or journal of the run; several with --merge")
      ->required()
      ->type_name("RESULT|JOURNAL");
  report_sub->add_flag("--merge", report.merge,
                       "Join them: the parts of a run (--shard) to the run, several devices to a matrix");
  add_reports(*report_sub, report.reports);
  report_sub
      ->add_option("--capture", report.capture,
                   "Comment this capture of the run with what was found (pcapng)")
      ->type_name("FILE");
  report_sub
      ->add_option("--captures", report.captures, "Folder for one pcapng per cause, cut out of --capture")
      ->type_name("FOLDER");
  add_bundle(*report_sub, report.bundle, report.sign);
  report_sub->add_flag("-q,--quiet", report.quiet, "Print no summary");
  report_sub->add_option("--color", report.color, "Colours: auto, always or never")
      ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
      ->type_name("WHEN");

  VerifyCommand verify;
  auto* verify_sub = app.add_subcommand(
      "verify",
      "Tell whether a bundle is as it was sealed; exits with 1 where it is not, with 2 where it is none");
  verify_sub->add_option("bundle", verify.bundle, "Bundle of a run (run --bundle)")
      ->required()
      ->type_name("FILE");
  verify_sub
      ->add_option("--key", verify.key,
                   "Public key of who must have signed it (openssl pkey -in KEY.pem -pubout)")
      ->type_name("PUBLIC.pem");
  verify_sub->add_option("--extract", verify.extract, "Unpack it into this new folder, if it is good")
      ->type_name("FOLDER");
  verify_sub->add_flag("--json", verify.json, "Output as JSON");

  WaiveCommand waive;
  auto* waive_sub =
      app.add_subcommand("waive", "Accept a failure of a run by name: add it to a file of waivers");
  waive_sub->add_option("result", waive.result, "Result (run --json) or journal of the run")
      ->required()
      ->type_name("RESULT|JOURNAL");
  waive_sub->add_option("-r,--requirement", waive.requirement, "The requirement that failed")
      ->required()
      ->type_name("ID");
  waive_sub->add_option("--reason", waive.reason, "Why it is accepted")->required()->type_name("TEXT");
  waive_sub->add_option("--case", waive.case_name, "Only in these cases (* and ? allowed; default: all)")
      ->type_name("ID");
  waive_sub->add_option("--object", waive.object, "Only what is about this object")->type_name("INDEX");
  waive_sub->add_option("--owner", waive.owner, "Who answers for it")->type_name("TEXT");
  waive_sub->add_option("--ticket", waive.ticket, "Where it is followed")->type_name("TEXT");
  waive_sub->add_option("--expires", waive.expires, "The last day on which it holds, as 2027-03-31")
      ->type_name("DATE");
  waive_sub->add_option("--file", waive.file, "File of waivers (default: waivers.yaml)")->type_name("FILE");

  CompareCommand compare;
  auto* compare_sub = app.add_subcommand(
      "compare", "Tell what changed between two runs; exits with 1 where the new one is worse");
  compare_sub->add_option("old", compare.before, "Result (run --json) or journal of the run before")
      ->required()
      ->type_name("OLD");
  compare_sub->add_option("new", compare.after, "Result or journal of the run after")
      ->required()
      ->type_name("NEW");
  compare_sub->add_option("-f,--format", compare.format, "Output: text, markdown or json")
      ->check(CLI::IsMember({"text", "markdown", "json"}).description(""))
      ->type_name("FORMAT");
  compare_sub
      ->add_option("--html", compare.html, "Also write it as one page for a browser, to send or to print")
      ->type_name("FILE");
  compare_sub->add_flag("--strict", compare.strict, "A new warning is worse, too");
  compare_sub->add_option("--color", compare.color, "Colours: auto, always or never")
      ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
      ->type_name("WHEN");

  RecoverCommand recover;
  auto* recover_sub = app.add_subcommand("recover", "Put back what a killed run left changed in the device");
  recover_sub
      ->add_option("journal", recover.journal,
                   "Journal of the run (default: the latest on interface and node)")
      ->type_name("JOURNAL");
  recover_sub->add_option("-i,--interface", recover.interface, "CAN interface the device is on now")
      ->type_name("NAME");
  recover_sub->add_option("-n,--node", recover.node, "Node-ID of the device, 1 to 127")
      ->check(CLI::Range(1, 127).description(""))
      ->type_name("NODE-ID");
  recover_sub->add_option("-d,--device", recover.device, "Device profile, if it is not where it was")
      ->type_name("FILE");
  recover_sub->add_option("--eds", recover.eds, "Description of the device, if it is not where it was")
      ->type_name("FILE");

  recover_sub->add_flag("--all", recover.all,
                        "Every value that the run changed, also those that were put back already");
  recover_sub->add_flag("--no-store", recover.no_store,
                        "Do not store (1010h) again where the killed run was storing or restoring");

  std::string guarded;
  auto* guard_sub = app.add_subcommand("guard", "Watches over a run");
  guard_sub->group("");
  guard_sub->add_option("--journal", guarded);

  JudgeCommand judge;
  auto* judge_sub = app.add_subcommand("judge", "Judge a recorded trace by the monitors, without a device");
  judge_sub->add_option("capture", judge.capture, "Capture: pcapng, or a log of candump -l")
      ->required()
      ->type_name("CAPTURE");
  judge_sub->add_option("select", judge.select, "Monitors: ids, * and ? allowed (default: all)")
      ->type_name("ID");
  judge_sub->add_option("-n,--node", judge.node, "Node-ID of the device, 1 to 127")
      ->check(CLI::Range(1, 127).description(""))
      ->type_name("NODE-ID");
  judge_sub
      ->add_option("-d,--device,--profile", judge.profile,
                   "Device profile (YAML): node-ID, times, known deviations")
      ->type_name("FILE");
  judge_sub->add_option("--eds", judge.eds, "Description of the device (EDS, DCF, XDD, XDC)")
      ->type_name("FILE");
  judge_sub->add_option("-i,--interface", judge.interface, "Which interface, where the capture has several")
      ->type_name("NAME");
  judge_sub
      ->add_option("-r,--requirement", judge.requirements,
                   "Only monitors that decide this requirement (* allowed); repeatable")
      ->allow_extra_args(false)
      ->type_name("ID");
  judge_sub
      ->add_option("-x,--exclude", judge.exclude, "Leave out these monitors (* and ? allowed); repeatable")
      ->allow_extra_args(false)
      ->type_name("ID");
  add_waivers(*judge_sub, judge.waivers);
  add_reports(*judge_sub, judge.reports);
  add_bundle(*judge_sub, judge.bundle, judge.sign);
  judge_sub->add_flag(
      "--strict", judge.strict,
      "Every deviation from a recommended or optional rule fails, also one that is tolerated otherwise");
  judge_sub->add_flag("-q,--quiet", judge.quiet, "Print only what did not pass, and the summary");
  judge_sub->add_option("--color", judge.color, "Colours: auto, always or never")
      ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
      ->type_name("WHEN");

  ReplayCommand replay;
  auto* replay_sub = app.add_subcommand(
      "replay", "Send what the harness sent in a recorded case; exits with 1 where the answers differ");
  replay_sub->add_option("recording", replay.capture, "Capture of a run: pcapng, or a log of candump -l")
      ->required()
      ->type_name("CAPTURE");
  replay_sub->add_option("--case", replay.case_name, "The case, as reports name it, with its instance")
      ->type_name("ID");
  replay_sub
      ->add_option("--frames", replay.frames,
                   "Frames instead of a case, such as 120-180, as Wireshark counts")
      ->type_name("FIRST-LAST");
  replay_sub
      ->add_option("-i,--interface", replay.interface, "CAN interface the device is on, for example can0")
      ->type_name("NAME");
  replay_sub->add_flag("--simulate", replay.simulate, "Send it to the reference node on a simulated bus");
  replay_sub->add_option("--variant", replay.variants, "Legal variant of the simulated node; repeatable")
      ->allow_extra_args(false)
      ->type_name("ID");
  replay_sub->add_option("--defect", replay.defects, "Defect to switch on in the simulated node; repeatable")
      ->allow_extra_args(false)
      ->type_name("ID");
  replay_sub
      ->add_option("-n,--node", replay.node,
                   "Node-ID of the device, 1 to 127 (default: the one the frames speak to)")
      ->check(CLI::Range(1, 127).description(""))
      ->type_name("NODE-ID");
  replay_sub->add_option("-d,--device", replay.device, "Device profile (YAML): times, what may be written")
      ->type_name("FILE");
  replay_sub
      ->add_option("--eds", replay.eds,
                   "Description of the device (EDS, DCF, XDD, XDC); with --simulate the node is its twin")
      ->type_name("FILE");
  replay_sub
      ->add_option(
          "--allow", replay.allow,
          "Highest risk to take: read-only, config, nvm or motion (default: read-only on real interfaces, motion on virtual ones)")
      ->type_name("RISK");
  replay_sub->add_option("--capture", replay.record, "Write the frames of the replay as pcapng")
      ->type_name("FILE");
  replay_sub->add_option("--seed", replay.seed, "Seed of the simulation (default 1)")->type_name("NUMBER");
  replay_sub->add_flag("-q,--quiet", replay.quiet, "Print only what differs, and the summary");
  replay_sub->add_option("--color", replay.color, "Colours: auto, always or never")
      ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
      ->type_name("WHEN");

  ScanCommand scan;
  auto* scan_sub = app.add_subcommand(
      "scan", "Read the dictionary of a device: write a draft EDS, or compare with a description");
  scan_sub->add_option("-i,--interface", scan.interface, "CAN interface the device is on, for example can0")
      ->type_name("NAME");
  auto* scan_simulate =
      scan_sub->add_flag("--simulate", scan.simulate, "Scan the reference node on a simulated bus");
  scan_sub->add_option("--eds", scan.twin, "Scan the twin of this device description in its place")
      ->needs(scan_simulate)
      ->type_name("FILE");
  scan_sub->add_option("-n,--node", scan.node, "Node-ID of the device, 1 to 127")
      ->check(CLI::Range(1, 127).description(""))
      ->type_name("NODE-ID");
  scan_sub
      ->add_option(
          "--allow", scan.allow,
          "Highest risk to take, to see what is read-only: read-only (default) writes nothing, config "
          "writes back what 1000h to 1FFFh hold, motion everything")
      ->check(CLI::IsMember({"read-only", "config", "nvm", "motion"}).description(""))
      ->type_name("RISK");
  auto* scan_compare = scan_sub
                           ->add_option("--compare", scan.compare,
                                        "Tell where the device and this description (EDS, DCF, XDD, XDC) "
                                        "differ; exits with 1 where they do")
                           ->type_name("FILE");
  scan_sub->add_option("--format", scan.format, "Output of the comparison: text or json")
      ->check(CLI::IsMember({"text", "json"}).description(""))
      ->needs(scan_compare)
      ->type_name("FORMAT");
  scan_sub
      ->add_option("--range", scan.ranges,
                   "Indices to look at, such as 2000h..2FFFh; repeatable (default 1000h..9FFFh)")
      ->allow_extra_args(false)
      ->type_name("RANGE");
  scan_sub
      ->add_option("-o,--output", scan.output,
                   "Write the draft to this file (default: standard output; none with --compare)")
      ->type_name("FILE");

  DoctorCommand doctor;
  auto* doctor_sub =
      app.add_subcommand("doctor", "Tell why a bus is dead, or who is on it, with the line to type");
  doctor_sub
      ->add_option("-i,--interface", doctor.interface,
                   "CAN interface, for example can0 (default: tell all there are)")
      ->type_name("NAME");
  doctor_sub->add_flag("--simulate", doctor.simulate, "The reference node on a simulated bus");
  doctor_sub->add_flag("--ask", doctor.ask, "Ask every node-ID for 1000h, after listening (reads only)");
  doctor_sub
      ->add_option("--listen", doctor.listen_ms, "Milliseconds to listen, sending nothing (default 2000)")
      ->check(CLI::Range(1, 3600000).description(""))
      ->type_name("MS");
  doctor_sub->add_option("--color", doctor.color, "Colours: auto, always or never")
      ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
      ->type_name("WHEN");

  InitCommand init;
  auto* init_sub =
      app.add_subcommand("init", "Look at a device, and write a device profile with comments to begin with");
  init_sub->add_option("-i,--interface", init.interface, "CAN interface the device is on, for example can0")
      ->type_name("NAME");
  init_sub->add_flag("--simulate", init.simulate, "Look at the reference node on a simulated bus");
  init_sub
      ->add_option("-n,--node", init.node,
                   "Node-ID of the device, 1 to 127 (default: the only one that answers)")
      ->check(CLI::Range(1, 127).description(""))
      ->type_name("NODE-ID");
  init_sub
      ->add_option("-o,--output", init.output, "File to write, - for standard output (default: device.yaml)")
      ->type_name("FILE");
  init_sub->add_flag("--force", init.force, "Write over a file that is there");
  init_sub
      ->add_option(
          "--allow", init.allow,
          "Highest risk to take: read-only (default) writes nothing, config also resets the device twice, to "
          "measure its start, and tries guarding, LSS and a block download that is given up")
      ->check(CLI::IsMember({"read-only", "config", "nvm", "motion"}).description(""))
      ->type_name("RISK");
  init_sub
      ->add_option("--range", init.ranges,
                   "Indices to look at, such as 1000h..1FFFh; repeatable (default 1000h..9FFFh)")
      ->allow_extra_args(false)
      ->type_name("RANGE");

  LssScanCommand lss_scan;
  auto* lss_scan_sub = app.add_subcommand(
      "lss-scan", "Find LSS slaves without node-ID by fastscan (CiA 305), and give them node-IDs");
  lss_scan_sub->add_option("-i,--interface", lss_scan.interface, "CAN interface, for example can0")
      ->type_name("NAME");
  lss_scan_sub->add_option("--simulate", lss_scan.simulate, "So many reference nodes on a simulated bus")
      ->check(CLI::Range(1, 127).description(""))
      ->type_name("NUMBER");
  lss_scan_sub
      ->add_option("--assign", lss_scan.assign,
                   "Give them node-IDs from this one on, until the next reset (default: none)")
      ->check(CLI::Range(1, 127).description(""))
      ->type_name("NODE-ID");
  lss_scan_sub
      ->add_option("--timeout", lss_scan.timeout_ms, "Milliseconds that an answer may take (default 100)")
      ->check(CLI::Range(1, 10000).description(""))
      ->type_name("MS");

  LintCommand lint;
  auto* lint_sub = app.add_subcommand("lint", "Check scenario files, without a bus");
  lint_sub->add_option("files", lint.files, "Files, and folders of own suites (default: the whole suites)")
      ->type_name("FILE");
  lint_sub->add_option("--color", lint.color, "Colours: auto, always or never")
      ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
      ->type_name("WHEN");

  conform::cli::EdsOptions eds;
  auto* eds_sub =
      app.add_subcommand("eds", "Look into device descriptions (EDS, DCF, XDD, XDC), without a device");
  eds.add_to(*eds_sub);

  ListCommand list;
  auto* list_sub = app.add_subcommand("list", "Show scenarios with their requirements");
  list_sub
      ->add_option("select", list.select, "Scenarios: ids or leading paths, * and ? allowed (default: all)")
      ->type_name("ID");
  list_sub->add_option("-r,--requirement", list.requirements, "Only scenarios that decide this requirement")
      ->allow_extra_args(false)
      ->type_name("ID");
  list_sub->add_flag("--cct", list.cct, "Compare with the cases of CiA's conformance test tool");

  ExplainCommand explain;
  auto* explain_sub = app.add_subcommand(
      "explain",
      "Explain requirements, scenarios, monitors, verbs, defects, variants or rules of 'eds lint'; list verbs, conditions, tiers or coverage");
  explain_sub
      ->add_option(
          "topic", explain.topics,
          "Ids such as OD-1003-06 or EDS212, verbs such as download, or: verbs, conditions, tiers, coverage")
      ->required()
      ->type_name("TOPIC");
  explain_sub->add_flag("--markdown", explain.markdown,
                        "With 'verbs' and 'coverage': the whole page as Markdown");

  SelftestCommand selftest;
  ExploreCommand explore;
  auto* explore_sub = add_explore(app, explore);

  auto* selftest_sub =
      app.add_subcommand("selftest", "Prove the suite: every defect of the reference node must be caught");
  selftest_sub->add_flag("-v,--verbose", selftest.verbose, "Show what killed each defect");
  selftest_sub->add_option("--defect", selftest.defects, "Only this defect; repeatable")
      ->allow_extra_args(false)
      ->type_name("ID");
  selftest_sub->add_flag(
      "--blame", selftest.blame,
      "Also whom the whole suite blames for each defect: one cause and a rule that it violates?");
  selftest_sub
      ->add_option(
          "--pairs", selftest.pairs,
          "With --blame: also for NUMBER pairs of defects of different parts of the device: two causes?")
      ->needs("--blame")
      ->type_name("NUMBER");
  selftest_sub
      ->add_option("--blame-page", selftest.blame_page,
                   "With --blame: write the share and the reasons of the others as Markdown")
      ->needs("--blame")
      ->type_name("FILE");
  selftest_sub
      ->add_option("--patterns", selftest.patterns,
                   "Write how each defect shows in a run of the whole suite, by which reports name known "
                   "mistakes; as JSON")
      ->type_name("FILE");
  selftest_sub
      ->add_option(
          "--worth", selftest.worth,
          "Write how long each case takes and how many defects it finds first, by which `run --budget` chooses; "
          "as JSON")
      ->type_name("FILE");
  selftest_sub
      ->add_option(
          "--budget", selftest.budget,
          "Instead of the whole suite: how many of the defects `run --budget TIME` finds; below four of "
          "five it ends with 1")
      ->type_name("TIME");
  selftest_sub->add_flag("--whole", selftest.whole,
                         "Run the whole suite for every defect, to see with -v what else it spoils");
  selftest_sub->add_flag(
      "--edits", selftest.edits,
      "Instead of the defects: break every entry of the dictionary in every way (absent, other length ...)");
  selftest_sub->add_flag(
      "--variants", selftest.variants,
      "Instead of the defects: every legal variant of the reference node, none of which may be failed");
  selftest_sub->add_flag("--full", selftest.full,
                         "Defects with --blame, --variants and --edits, one after the other");
  selftest_sub
      ->add_option("--html", selftest.html,
                   "Write what was proven as one page for a browser, to send or to print")
      ->type_name("FILE");
  selftest_sub->add_flag("--mutants", selftest.mutants,
                         "Instead of the defects: small mistakes at every place of the reference node "
                         "(canopen-conform-mutants only)");
  selftest_sub->add_option("--mutant", selftest.mutant, "Only this mutant, room or file; repeatable")
      ->allow_extra_args(false)
      ->needs("--mutants")
      ->type_name("NUMBER|ROOM|FILE");
  selftest_sub->add_option("--sample", selftest.sample, "Only NUMBER of the mutants, drawn by the seed")
      ->needs("--mutants")
      ->type_name("NUMBER");
  selftest_sub->add_flag("--quick", selftest.quick, "With --mutants: leave out the scenarios that take long")
      ->needs("--mutants");
  selftest_sub->add_option("-j,--jobs", selftest.jobs, "Threads (default: the machine's cores)")
      ->check(CLI::Range(1, 256))
      ->type_name("NUMBER");
  selftest_sub->add_option("--seed", selftest.seed, "Seed of the simulation (default 1)")
      ->type_name("NUMBER");
  selftest_sub
      ->add_option("--markdown", selftest.markdown,
                   "Write the matrix of requirements and defects, or the score of the mutants, as Markdown")
      ->type_name("FILE");

  std::string shell;
  auto* completion_sub = app.add_subcommand(
      "completion", "Print what a shell reads to complete the command lines of this program");
  completion_sub->add_option("shell", shell, "bash, zsh or fish")
      ->required()
      ->check(
          CLI::IsMember(std::vector<std::string>(usage::shells.begin(), usage::shells.end())).description(""))
      ->type_name("SHELL");

  BenchCommand bench;
  auto* bench_sub = app.add_subcommand("bench", "Round trips per second through the harness");
  bench_sub->group("");
  auto* bench_bus = bench_sub->add_option("--interface", bench.interface);
  auto* bench_simulation =
      bench_sub->add_option("--simulate", bench.simulate)->check(CLI::Range(1000, 1'000'000));
  bench_bus->excludes(bench_simulation);
  bench_sub->add_option("--node", bench.node);
  bench_sub->add_option("--round-trips", bench.round_trips);
  bench_sub->add_option("--bytes", bench.bytes)->check(CLI::Range(10, 1 << 20));

  std::vector<std::string> suites;
  for (auto* sub : {judge_sub, lint_sub, list_sub, explain_sub, explore_sub, selftest_sub}) {
    sub->add_option(
           "--suites", suites,
           "Folder of own scenarios and requirements, beside those that came with the program; repeatable")
        ->allow_extra_args(false)
        ->type_name("FOLDER");
  }
  const auto told = manual();
  usage::add_examples(app, told);
  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  if (const auto answer = usage::answer_hidden(app, arguments, told, known_values, CONFORM_VERSION)) {
    if (!*answer) return report_error(answer->error(), exit_usage);
    print(**answer);
    return 0;
  }
  const auto line = merge_settings(std::span(argv, static_cast<std::size_t>(argc)), environment);
  std::vector<const char*> words;
  for (const auto& word : line.words) words.push_back(word.c_str());
  try {
    app.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::ParseError& error) {
    if (app.exit(error) == 0) return 0;
    std::fputs(origins_in(error.what(), line).c_str(), stderr);
    return exit_usage;
  }
  judge.suites = lint.suites = list.suites = explain.suites = explore.suites = selftest.suites = suites;
  judge.command = shell_line(std::span(argv, static_cast<std::size_t>(argc)));
  if (guard_sub->parsed()) return guard_command(guarded);
  if (run_sub->parsed()) {
    run.command.command = shell_line(line.told);
    return run.run(line);
  }
  if (report_sub->parsed()) return report_command(report);
  if (verify_sub->parsed()) return verify_command(verify);
  if (waive_sub->parsed()) return waive_command(waive);
  if (compare_sub->parsed()) return compare_command(compare);
  if (recover_sub->parsed()) return recover_command(recover);
  if (judge_sub->parsed()) return judge_command(judge);
  if (replay_sub->parsed()) return replay_command(replay);
  if (lint_sub->parsed()) return lint_command(lint);
  if (eds_sub->parsed()) return eds.run();
  if (list_sub->parsed()) return list_command(list);
  if (scan_sub->parsed()) return scan_command(scan);
  if (doctor_sub->parsed()) return doctor_command(doctor);
  if (init_sub->parsed()) return init_command(init);
  if (lss_scan_sub->parsed()) return lss_scan_command(lss_scan);
  if (explain_sub->parsed()) return explain_command(explain);
  if (explore_sub->parsed()) return explore_command(explore);
  if (selftest_sub->parsed()) return selftest_command(selftest);
  if (completion_sub->parsed()) {
    print(usage::completion_script(shell, "canopen-conform"));
    return 0;
  }
  return bench_command(bench);
}

}  // namespace

int main(int argc, char** argv) {
  // The one seam where exceptions of third-party code end.
  try {
    return dispatch(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("canopen-conform: there is no more memory\n", stderr);
    return conform::cli::exit_environment;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "canopen-conform: internal error: %s\n", error.what());
    return conform::cli::exit_environment;
  }
}
