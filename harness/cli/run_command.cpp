// SPDX-License-Identifier: Apache-2.0
// `run`: the suite against a device on an interface, or against the reference node on the simulated bus.
#include <fmt/format.h>
#include <signal.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <ctime>
#include <optional>

#include "base/files.hpp"
#include "base/text.hpp"
#include "can/candump_log.hpp"
#include "can/interface_lock.hpp"
#include "can/pcapng.hpp"
#include "can/socketcan_interface.hpp"
#include "can/socketcan_transport.hpp"
#include "cli/commands.hpp"
#include "cli/known_device.hpp"
#include "cli/selftest.hpp"
#include "cli/suite_folder.hpp"
#include "cli/terminal.hpp"
#include "cli/variant_profile.hpp"
#include "engine/monitor_cases.hpp"
#include "node.hpp"
#include "reports/console.hpp"
#include "reports/junit.hpp"
#include "reports/markdown.hpp"

namespace conform::cli {
namespace {

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

Result<KnownDevice> device_of(const RunCommand& options, const std::string& suites) {
  DeviceWords words{options.device, options.eds, options.node};
  const bool of_reference_node = options.simulate && words.profile.empty() && words.eds.empty();
  if (of_reference_node) words.profile = suites + "/devices/reference-node.yaml";
  auto known = known_device(words, options.simulate ? std::optional(NodeId(5)) : std::nullopt);
  if (known && of_reference_node && !options.variants.empty()) {
    auto node = refnode::Node::create(
        {.node_id = known->profile.node.value(), .defects = {}, .variants = options.variants});
    if (!node) return std::unexpected(node.error());
    known->profile = profile_of_variants(known->profile, (*node)->dictionary(), options.variants);
  }
  if (known && !options.interface.empty()) known->profile.interface = options.interface;
  return known;
}

/// Reports that are kept up to date while the run goes on, so that even kill -9 leaves a valid file.
class LiveReports {
 public:
  LiveReports(const RunCommand& options, std::string tool, std::string host, std::int64_t started)
      : options_(options), tool_(std::move(tool)), host_(std::move(host)), started_(started) {}

  void complete(result::RunResult& run) const {
    run.tool = tool_;
    run.host = host_;
    run.started_utc_ns = started_;
    run.properties.insert(run.properties.begin(), properties_.begin(), properties_.end());
  }
  void add_property(std::string name, std::string value) {
    properties_.push_back({std::move(name), std::move(value)});
  }

  /// At most four times a second: writing after every case would cost more than the cases.
  void refresh(const result::RunResult& run, bool force) {
    if (options_.junit.empty()) return;
    const auto now = std::chrono::steady_clock::now();
    if (!force && now - last_ < std::chrono::milliseconds(250)) return;
    last_ = now;
    auto copy = run;
    complete(copy);
    write_junit(copy);
  }
  void write_junit(const result::RunResult& run) {
    if (options_.junit.empty()) return;
    auto written = write_file_atomically(
        options_.junit, reports::junit(run, {.class_prefix = {}, .source_prefix = "suites/"}));
    if (!written && !failed_) {
      failed_ = true;
      report_error(written.error(), 0);
    }
  }
  [[nodiscard]] bool failed() const { return failed_; }
  void write(const std::string& path, ByteView bytes) {
    if (path.empty()) return;
    if (auto written = write_file_atomically(path, bytes); !written) {
      failed_ = true;
      report_error(written.error(), 0);
    }
  }
  void write(const std::string& path, const std::string& text) {
    write(path, ByteView(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  }

 private:
  const RunCommand& options_;
  std::string tool_, host_;
  std::int64_t started_;
  std::vector<result::Property> properties_;
  std::chrono::steady_clock::time_point last_{};
  bool failed_ = false;
};

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
    out += fmt::format("{:9}  {:9}  {}  {}\n", what, to_string(planned.scenario->risk), result.name(),
                       join(result.requirements, ", "));
  }
  for (const auto* rule : monitors) {
    const auto result = monitor::planned_case(*rule, [](std::string_view) { return result::Verdict::fail; });
    out += fmt::format("{:9}  {:9}  {}  {}\n", "watches", "", result.name(), join(result.requirements, ", "));
  }
  out += fmt::format("{} cases, {} would run; nothing was sent\n", plan.size(), plan.size() - held_back);
  print(out);
}

}  // namespace

int run_command(const RunCommand& options) {
  if (options.simulate == !options.interface.empty() && (options.simulate || options.device.empty())) {
    return report_error(
        {"say where the device is", {}, "--interface can0 for a device, --simulate for the reference node"},
        exit_usage);
  }
  for (const auto& [option, ids] :
       {std::pair{"--defect", &options.defects}, {"--variant", &options.variants}}) {
    if (options.simulate || ids->empty()) continue;
    return report_error({std::string(option) + " belongs to --simulate",
                         {},
                         std::string("on a real interface: canopen-refnode ") + option + " ID"},
                        exit_usage);
  }
  auto root = find_suites(options.suites);
  if (!root) return report_error(root.error(), exit_usage);
  const bool colour = use_colour(options.color, 1);
  auto suites = load_suites(*root, use_colour(options.color, 2));
  if (!suites) return report_error(suites.error(), exit_usage);
  auto known = device_of(options, *root);
  if (!known) return report_error(known.error(), exit_usage);
  auto* const profile = &known->profile;

  engine::RunOptions run_options;
  run_options.strict = options.strict;
  run_options.stop = &stop_signal;
  run_options.plan.selection = {options.select, options.requirements, options.exclude};
  run_options.plan.seed = options.seed;
  run_options.plan.all_objects = options.all_objects;
  run_options.plan.slow = options.slow || options.simulate;
  for (const auto& id : options.requirements) {
    if (id.find('*') == std::string::npos && suites->catalogue.find(id) == nullptr) {
      const auto near = did_you_mean(id, suites->catalogue.ids());
      return report_error({"unknown requirement '" + id + "'",
                           {},
                           near.empty() ? "" : "did you mean '" + std::string(near) + "'?"},
                          exit_usage);
    }
  }
  {
    auto everything = run_options.plan;
    everything.allowed = scenario::Risk::motion;
    if (engine::plan(suites->suite, suites->catalogue, device::dictionary_of(*profile), everything).empty() &&
        !engine::names_a_monitor(everything.selection, suites->catalogue)) {
      return report_error(
          {"nothing is selected: no scenario matches", {}, "'canopen-conform list' shows what there is"},
          exit_usage);
    }
  }

  std::optional<can::InterfaceLock> lock;
  std::unique_ptr<can::SocketCanTransport> transport;
  if (!options.simulate && !options.dry_run) {
    if (profile->interface.empty())
      return report_error(
          {"no interface is named", {}, "--interface can0, or interface: in the device profile"}, exit_usage);
    auto opened = can::SocketCanTransport::open(profile->interface);
    if (!opened) return report_error(opened.error(), exit_environment);
    transport = std::move(*opened);
    auto taken = can::InterfaceLock::take(profile->interface);
    if (!taken) return report_error(taken.error(), exit_environment);
    lock.emplace(std::move(*taken));
  }
  // A real machine may hang on a real interface: without --allow nothing is written to it.
  const bool is_virtual = options.simulate || (transport != nullptr && transport->info().is_virtual);
  run_options.plan.allowed = is_virtual ? scenario::Risk::motion : scenario::Risk::read_only;
  if (!options.allow.empty()) {
    const auto risk = scenario::parse_risk(options.allow);
    if (!risk)
      return report_error(
          {"unknown risk tier '" + options.allow + "'", {}, "read-only, config, nvm or motion"}, exit_usage);
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

  catch_signals();
  char host[256] = "unknown";
  if (!options.simulate) ::gethostname(host, sizeof host - 1);
  LiveReports reports(options, "canopen-conform " CONFORM_VERSION, options.simulate ? "simulation" : host,
                      options.simulate ? 0 : static_cast<std::int64_t>(std::time(nullptr)) * 1'000'000'000);
  reports.add_property("suite.digest", suite_digest(*root));
  if (known->description) reports.add_property("dut.description", known->description->name);
  reports.add_property("run.seed", std::to_string(options.seed));
  reports.add_property("run.allowed", std::string(to_string(run_options.plan.allowed)));
  if (transport != nullptr) {
    const auto info = transport->info();
    reports.add_property("can.interface", info.name);
    reports.add_property("can.driver", info.driver);
    if (info.bit_rate > 0) reports.add_property("can.bit_rate", std::to_string(info.bit_rate));
    reports.add_property("can.receive_buffer", std::to_string(info.receive_buffer));
  } else {
    reports.add_property("can.interface", "simulated");
    if (!options.defects.empty()) reports.add_property("simulation.defects", join(options.defects, " "));
    if (!options.variants.empty()) reports.add_property("simulation.variants", join(options.variants, " "));
  }

  const bool live = ::isatty(1) != 0 && !options.quiet;
  const reports::Style style{colour, terminal_width(), 0};
  std::size_t done = 0;
  run_options.on_planned = [&](const result::RunResult& run) { reports.refresh(run, true); };
  run_options.on_case_begin = [&](const result::RunResult& run, std::size_t index) {
    if (!live) return;
    print("\r\x1B[K" +
          reports::progress(index + 1, run.cases.size(), run.cases[index].name(), run.counts(), style));
    std::fflush(stdout);
  };
  run_options.on_case_end = [&](const result::RunResult& run, std::size_t index) {
    ++done;
    const auto& each = run.cases[index];
    const bool quiet_verdict =
        each.verdict == result::Verdict::pass || each.verdict == result::Verdict::not_applicable;
    if (live) {
      if (!quiet_verdict) print("\r\x1B[K" + reports::case_line(each, style) + "\n");
    } else if (!options.quiet || !quiet_verdict) {
      print(reports::case_line(each, style) + "\n");
    }
    reports.refresh(run, false);
  };

  result::RunResult run;
  can::Capture capture;
  std::int64_t epoch = 0;
  if (options.simulate) {
    auto simulated = simulate(
        {.defects = options.defects, .variants = options.variants, .description = known->description},
        *profile, suites->suite, suites->catalogue, run_options, options.seed);
    if (!simulated) return report_error(simulated.error(), exit_usage);
    run = std::move(simulated->result);
    capture = std::move(simulated->capture);
  } else {
    epoch = transport->info().epoch_ns;
    run = engine::run(*transport, *profile, suites->suite, suites->catalogue, run_options, capture);
  }
  if (live) print("\r\x1B[K");
  run.notes.insert(run.notes.begin(), known->notes.begin(), known->notes.end());
  reports.complete(run);
  reports.write_junit(run);
  can::CaptureInfo info;
  info.interface_name = options.simulate ? "simulated" : profile->interface;
  info.epoch_ns = epoch;
  info.tool = run.tool;
  info.comment = run.device;
  if (!options.capture.empty()) reports.write(options.capture, can::write_pcapng(capture, info));
  if (!options.candump.empty()) reports.write(options.candump, can::write_candump_log(capture, info));
  if (!options.markdown.empty()) reports.write(options.markdown, reports::markdown(run));
  print(reports::summary(run, style));
  std::fflush(stdout);
  const auto code = result::exit_code(run);
  return reports.failed() && code == 0 ? exit_environment : code;
}

}  // namespace conform::cli
