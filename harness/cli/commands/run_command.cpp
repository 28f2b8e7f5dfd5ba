// SPDX-License-Identifier: Apache-2.0
// `run`: the suite against a device on an interface, or against the reference node on the simulated bus.
#include <fmt/format.h>
#include <signal.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <future>
#include <optional>
#include <system_error>

#include "base/text.hpp"
#include "can/interface_lock.hpp"
#include "can/socketcan_interface.hpp"
#include "can/socketcan_transport.hpp"
#include "cli/commands/commands.hpp"
#include "cli/pages/cct_run.hpp"
#include "cli/proof/selftest.hpp"
#include "cli/run/bus_facts.hpp"
#include "cli/run/choice.hpp"
#include "cli/run/device_under_test.hpp"
#include "cli/run/guardian.hpp"
#include "cli/run/run_journal.hpp"
#include "cli/run/run_reports.hpp"
#include "cli/run/run_source.hpp"
#include "cli/run/run_watch.hpp"
#include "cli/run/shell.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "engine/monitor_cases.hpp"
#include "reports/annotations.hpp"
#include "reports/compare.hpp"
#include "reports/console.hpp"

namespace conform::cli {
namespace {

/// None: the cases in their own order.
std::optional<std::uint64_t> shuffle_seed(const RunCommand& options) {
  if (options.shuffle.empty() || options.shuffle == "false") return std::nullopt;
  return options.shuffle == "true" ? options.seed : parse_number(options.shuffle);
}

std::atomic<int> stop_signal{0};

/// The first signal ends the run in good order; the second one at once.
void on_signal(int signal) {
  if (stop_signal.exchange(signal) != 0) ::_exit(128 + signal);
}

void catch_signals() {
  struct sigaction action{};
  action.sa_handler = on_signal;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  // A closed terminal must not leave the device changed; nohup has its way.
  struct sigaction hangup{};
  ::sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);
  // A closed pipe (| head) must not cost the reports.
  std::signal(SIGPIPE, SIG_IGN);
}

/// What the command line knows of a run.
struct Facts {
  std::string host;
  std::int64_t started = 0;
  std::vector<result::Property> properties;
  std::vector<std::string> notes;

  void complete(result::RunResult& run) const {
    run.tool = tool;
    run.host = host;
    run.started_utc_ns = started;
    run.properties.insert(run.properties.begin(), properties.begin(), properties.end());
    run.notes.insert(run.notes.begin(), notes.begin(), notes.end());
  }
  void add(std::string name, std::string value) { properties.push_back({std::move(name), std::move(value)}); }

  void add(const std::vector<result::Property>& more) {
    properties.insert(properties.end(), more.begin(), more.end());
  }

  static constexpr const char* tool = "canopen-conform " CONFORM_VERSION;
};

/// Says what the run before left in the device, before anything else is done to it.
void tell_what_was_left(const RunJournal& journal, Facts& facts) {
  if (journal.left().empty()) return;
  std::string text =
      journal.earlier_was_killed()
          ? "an earlier run on this interface and node was killed and left values of the device changed:"
          : "an earlier run on this interface and node could not put back all that it changed:";
  for (const auto& each : journal.left()) {
    const auto what = to_string(each.object) + " was " + hex_bytes(each.before) +
                      (each.during.empty() ? "" : " before " + each.during);
    text += "\n  " + what;
    facts.notes.push_back("left changed by an earlier run: " + what);
  }
  // The place of a journal goes by interface and node-ID, and another device may have them by now.
  if (!journal.left_in().empty()) text += "\n  in the device with " + journal.left_in();
  report_error(
      {text, {}, "canopen-conform recover " + journal.path() + " puts them back, in that device only"}, 0);
}

void print_plan(const std::vector<engine::PlannedCase>& plan, const engine::Monitors& monitors,
                const scenario::Catalogue& catalogue) {
  std::string out;
  std::size_t held_back = 0;
  for (const auto& planned : plan) {
    const auto result = engine::planned_result(planned, catalogue);
    if (!planned.held_back.empty() || !planned.not_applicable.empty()) ++held_back;
    const char* what = !planned.held_back.empty()        ? "held back"
                       : !planned.not_applicable.empty() ? "not appl."
                                                         : "would run";
    out += fmt::format("{:9}  {:9}  {}  {}\n", what, steps::word_of(planned.scenario->risk), result.name(),
                       join(result.requirements, ", "));
  }
  for (const auto* rule : monitors) {
    const auto result = monitor::planned_case(*rule, [](std::string_view) { return result::Verdict::fail; });
    out += fmt::format("{:9}  {:9}  {}  {}\n", "watches", "", result.name(), join(result.requirements, ", "));
  }
  out += fmt::format("{} cases, {} would run; nothing was sent\n", plan.size(), plan.size() - held_back);
  print(out);
}

/// Prints what is different. What the baseline failed as well is no reason for the exit code any more; that
/// the run was ended, judged nothing, or is not whole remains one.
int compare_with(const result::RunResult& baseline, const result::RunResult& run, const RunCommand& options,
                 const reports::Style& style) {
  const auto comparison = result::compare(baseline, run);
  const int own = result::exit_code(run);
  int code = result::exit_code(comparison, options.strict);
  // The file of waivers is wrong, whatever the device does.
  if (run.has_wrong_waiver()) code = 1;
  if (code == 0 && (run.aborted || !run.unwritten.empty())) code = exit_environment;
  if (run.signal != 0 || own == exit_usage) code = own;
  print(fmt::format("\nAgainst the baseline\n--------------------\n{}exit code {} instead of {}\n",
                    reports::compare_text(comparison, {options.strict, options.baseline, "this run"}, style),
                    code, own));
  return code;
}

int run(const RunCommand& options, RunReports& reports, std::optional<result::RunResult>* done) {
  const auto refuse = [&reports](const Error& error, int code) {
    reports.not_begun(Facts::tool, error);
    return report_error(error, code);
  };
  if (options.simulate == !options.interface.empty() && (options.simulate || options.device.empty())) {
    return refuse(no_device_named(), exit_usage);
  }
  for (const auto& [option, ids] :
       {std::pair{"--defect", &options.defects}, {"--variant", &options.variants}}) {
    if (options.simulate || ids->empty()) continue;
    return refuse({std::string(option) + " belongs to --simulate",
                   {},
                   std::string("on a real interface: canopen-refnode ") + option + " ID"},
                  exit_usage);
  }
  std::optional<result::RunResult> baseline;
  if (!options.baseline.empty()) {
    if (absolute(options.baseline) == absolute(options.journal))
      return refuse({"the journal would be written over the baseline", options.baseline, {}}, exit_usage);
    auto read = read_run_to_compare(options.baseline);
    if (!read) return refuse(read.error(), exit_usage);
    baseline.emplace(std::move(*read));
  }
  auto root = find_suites(options.suites, options.device);
  if (!root) return refuse(root.error(), exit_usage);
  const bool colour = use_colour(options.color, 1);
  auto suites = load_suites(*root, use_colour(options.color, 2));
  if (!suites) return refuse(suites.error(), exit_usage);
  // Megabytes, read by another processor until they are asked for.
  auto reading = std::async(std::launch::async, load_patterns, root->root);
  auto digesting = std::async(std::launch::async, suite_properties, *root);
  auto known = device_under_test({options.device, options.eds, options.node, options.waivers},
                                 {options.simulate, options.variants, root->root});
  if (!known) return refuse(known.error(), exit_usage);
  auto* const profile = &known->profile;
  if (!options.interface.empty()) profile->interface = options.interface;
  device::scale_times(*profile, options.timeout_scale);

  engine::RunOptions run_options;
  run_options.strict = options.strict;
  run_options.today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  run_options.measure = !reports.none() || baseline.has_value();
  run_options.comment_parts = reports.keeps_comments();
  run_options.stop = &stop_signal;
  constexpr Duration power_limit = std::chrono::seconds(60);
  if (!options.simulate && !profile->power_cycle.empty())
    run_options.power_cycle = [profile, power_limit] { return run_shell(profile->power_cycle, power_limit); };
  run_options.plan.selection = {options.select, options.requirements, options.exclude};
  run_options.plan.seed = options.seed;
  run_options.plan.shuffle = shuffle_seed(options);
  if (options.cct) run_options.plan.order = cct_order(suites->suite, suites->catalogue);
  run_options.plan.all_objects = options.all_objects;
  run_options.plan.slow = options.slow || options.simulate;
  const auto patience = parse_duration(options.wait_for_bus);
  if (!patience)
    return refuse({"'" + options.wait_for_bus + "' is no time", {}, "--wait-for-bus '30 s'"}, exit_usage);
  run_options.bus_patience = *patience;
  if (auto chosen = choose(options.choice, run_options); !chosen) return refuse(chosen.error(), exit_usage);
  const bool live = ::isatty(STDOUT_FILENO) != 0 && !options.quiet;
  result::Worths worths;
  if (run_options.budget || live) {
    auto read = load_worths(root->root);
    if (!read) return refuse(read.error(), exit_usage);
    worths = std::move(*read);
  }
  if (run_options.budget) run_options.plan.worths = &worths;
  if (run_options.plan.only && run_options.plan.only->empty()) {
    reports.not_begun(Facts::tool, {"every case of " + options.choice.rerun_failed + " passed", {}, {}});
    print("no case of " + options.choice.rerun_failed +
          " failed or was left open: there is nothing to run again\n");
    return 0;
  }
  if (!options.choice.rerun_failed.empty() && !run_options.plan.only && !options.quiet)
    std::fprintf(
        stderr,
        "canopen-conform: a rule was broken or left open outside of the cases of %s: all of them are "
        "played again\n",
        options.choice.rerun_failed.c_str());
  for (const auto& id : options.requirements) {
    if (id.find('*') == std::string::npos && suites->catalogue.find(id) == nullptr) {
      const auto near = did_you_mean(id, suites->catalogue.ids());
      return refuse({"unknown requirement '" + id + "'",
                     {},
                     near.empty() ? "" : "did you mean '" + std::string(near) + "'?"},
                    exit_usage);
    }
  }
  if (auto sound = is_there(*suites, device::dictionary_of(*profile), run_options.plan); !sound)
    return refuse(sound.error(), exit_usage);
  const auto patterns = reading.get();
  if (!patterns) return refuse(patterns.error(), exit_usage);

  std::optional<can::InterfaceLock> lock;
  std::unique_ptr<can::SocketCanTransport> transport;
  if (!options.simulate && !options.dry_run) {
    if (profile->interface.empty())
      return refuse({"no interface is named", {}, "--interface can0, or interface: in the device profile"},
                    exit_usage);
    auto opened = can::SocketCanTransport::open(profile->interface);
    if (!opened) return refuse(opened.error(), exit_environment);
    transport = std::move(*opened);
    auto taken = can::InterfaceLock::take(profile->interface);
    if (!taken) return refuse(taken.error(), exit_environment);
    lock.emplace(std::move(*taken));
  }
  // A real machine may hang on a real interface: without --allow nothing is written to it.
  const bool is_virtual = options.simulate || (transport != nullptr && transport->info().is_virtual);
  run_options.plan.allowed = is_virtual ? scenario::Risk::motion : scenario::Risk::read_only;
  if (!options.allow.empty()) {
    const auto risk = steps::parse_tier(options.allow);
    if (!risk)
      return refuse({"unknown risk tier '" + options.allow + "'", {}, "read-only, config, nvm or motion"},
                    exit_usage);
    run_options.plan.allowed = *risk;
  }
  if (options.dry_run && options.allow.empty() && !options.simulate) {
    auto facts = can::interface_facts(profile->interface);
    if (facts && facts->is_virtual) run_options.plan.allowed = scenario::Risk::motion;
  }
  // Without a list of what may be written, the user who allows motion allows all that the description calls
  // writable.
  profile->writes_described =
      run_options.plan.allowed == scenario::Risk::motion && profile->safe_objects.empty();
  if (options.dry_run) {
    print_plan(
        engine::plan(suites->suite, suites->catalogue, device::dictionary_of(*profile), run_options.plan),
        engine::chosen_monitors(run_options.plan.selection, suites->catalogue), suites->catalogue);
    return 0;
  }

  Facts facts;
  char host[256] = "unknown";
  if (!options.simulate) ::gethostname(host, sizeof host - 1);
  facts.host = options.simulate ? "simulation" : host;
  facts.started = options.simulate ? 0 : static_cast<std::int64_t>(std::time(nullptr)) * 1'000'000'000;
  facts.notes = known->notes;
  facts.properties = digesting.get();
  auto taken = take_inputs(known->files, *root, reports.has_bundle());
  if (!taken) return refuse(taken.error(), exit_usage);
  facts.add(taken->told);
  if (reports.has_bundle()) {
    if (auto kept = reports.keep(Facts::tool, std::move(taken->inputs)); !kept)
      return refuse(kept.error(), exit_usage);
  }
  facts.add(known->properties());
  facts.add("run.command", options.command);
  facts.add("run.seed", std::to_string(options.seed));
  if (const auto& seed = run_options.plan.shuffle) facts.add("run.shuffle", std::to_string(*seed));
  if (!options.choice.shard.empty()) facts.add("run.shard", options.choice.shard);
  if (run_options.budget) facts.add("run.budget", to_string(*run_options.budget));
  if (options.timeout_scale != 1) facts.add("run.timeout_scale", fmt::format("{}", options.timeout_scale));
  facts.add("run.allowed", std::string(steps::word_of(run_options.plan.allowed)));
  if (transport != nullptr) {
    facts.add(bus_properties(transport->info()));
    facts.add(host_properties());
  } else {
    facts.add("can.interface", "simulated");
    if (!options.defects.empty()) facts.add("simulation.defects", join(options.defects, " "));
    if (!options.variants.empty()) facts.add("simulation.variants", join(options.variants, " "));
  }

  can::CaptureInfo info;
  info.interface_name = options.simulate ? "simulated" : profile->interface;
  info.epoch_ns = transport != nullptr ? transport->info().epoch_ns : 0;
  info.tool = Facts::tool;
  info.comment = profile->name;
  if (auto opened = reports.stream(info); !opened) return refuse(opened.error(), exit_environment);

  // A run of which no file is asked, and that touches no device, leaves nothing to look after.
  std::optional<RunJournal> kept;
  std::optional<journal::Writer> journal;
  std::optional<Guardian> guardian;
  if (!options.simulate || !options.journal.empty() || !reports.none()) {
    auto opened = RunJournal::open(options.journal, info.interface_name, profile->node.value(),
                                   options.simulate, reports.first());
    if (!opened) return refuse(opened.error(), exit_environment);
    kept.emplace(std::move(*opened));
    if (!options.simulate) tell_what_was_left(*kept, facts);
    if (!kept->why_not_usual().empty())
      facts.notes.push_back("the journal is not at its usual place, so the next run will not find it: " +
                            kept->why_not_usual());
    journal.emplace(kept->descriptor());
    result::RunResult begun;
    facts.complete(begun);
    begun.device = profile->name;
    auto begins = kept->begin(*journal,
                              {.interface = info.interface_name,
                               .node = profile->node.value(),
                               .simulated = options.simulate,
                               .profile = absolute(options.device),
                               .eds = absolute(options.eds),
                               .suites = absolute(root->root),
                               .epoch_ns = info.epoch_ns,
                               .reports = reports.paths()},
                              begun);
    if (!begins) return refuse(begins.error(), exit_environment);
    guardian.emplace(*kept);
    record_faults_in(kept->descriptor());
    if (options.simulate) watch_progress(kept->descriptor());
  }

  const reports::Style style{colour, terminal_width(), 0};
  RunWatch watch({live, options.quiet, style, live ? &worths : nullptr, run_options.budget}, reports,
                 journal ? &*journal : nullptr, [&facts](result::RunResult& run) { facts.complete(run); });
  run_options.observer = &watch;

  result::RunResult run;
  can::Capture capture;
  if (options.simulate) {
    auto simulated = simulate(
        {.defects = options.defects, .variants = options.variants, .description = known->description},
        *profile, suites->suite, suites->catalogue, run_options, options.seed);
    stop_watching();
    if (!simulated) {
      // The reports say why it did not begin; the guardian has nothing to add.
      if (journal) journal->reported();
      return refuse(simulated.error(), exit_usage);
    }
    run = std::move(simulated->result);
    capture = std::move(simulated->capture);
  } else {
    run = engine::run(*transport, *profile, suites->suite, suites->catalogue, run_options, capture);
    facts.add(health_properties(transport->info(), transport->health()));
  }
  if (live) print("\r\x1B[K");
  facts.complete(run);
  run.changes = watch.changes();
  run.likenesses = result::likenesses_of(run, *patterns);
  if (options.cct)
    run.compared = cct_outcomes(run, suites->suite, suites->catalogue, known->description.get());
  if (journal) journal->finished(run);
  if (journal && journal->error() != 0)
    run.unwritten.push_back((kept->path().empty() ? "the journal" : kept->path()) +
                            ": cannot write: " + std::generic_category().message(journal->error()));
  info.comment = run.device;
  reports.write(run, capture, info);
  if (journal) journal->reported();
  print(reports::summary(run, style));
  if (options.annotate) print(reports::github_annotations(run));
  const int code = baseline ? compare_with(*baseline, run, options, style) : result::exit_code(run);
  std::fflush(stdout);
  if (done != nullptr) *done = std::move(run);
  return code;
}

}  // namespace

int run_command(const RunCommand& options, std::optional<result::RunResult>* done) {
  catch_signals();
  // Also into a file, so that what was said is there when the program is killed.
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  RunReports reports(absolute_paths(options.reports, {.capture = options.capture,
                                                      .candump = options.candump,
                                                      .captures = options.captures,
                                                      .bundle = options.bundle}));
  if (options.dry_run) {
    RunReports none({});
    return run(options, none, done);
  }
  if (auto key = reports.sign_with(options.sign); !key) return report_error(key.error(), exit_usage);
  if (auto begun = reports.begin(
          Facts::tool, {options.device, options.eds, options.journal, options.baseline, options.sign});
      !begun)
    return report_error(begun.error(), exit_environment);
  return run(options, reports, done);
}

}  // namespace conform::cli
