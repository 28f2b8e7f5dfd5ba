// SPDX-License-Identifier: Apache-2.0
// `explore`: looks for what no scenario asks for, in simulation.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

#include "base/files.hpp"
#include "base/shell_word.hpp"
#include "base/text.hpp"
#include "canopen/decode.hpp"
#include "cli/commands/commands.hpp"
#include "cli/commands/explore_command.hpp"
#include "cli/proof/explored.hpp"
#include "cli/run/device_under_test.hpp"
#include "cli/run/stop_signal.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "explore/scenario_text.hpp"

namespace conform::cli {
namespace {

/// The command that finds it again, whatever the machine is worth.
std::string again(const ExploreCommand& options, std::size_t actions) {
  std::string out = "canopen-conform explore --simulate";
  const auto add = [&](std::string_view option, const std::string& value) {
    out += fmt::format(" {} {}", option, shell_word(value));
  };
  for (const auto& id : options.defects) add("--defect", id);
  for (const auto& id : options.variants) add("--variant", id);
  if (!options.eds.empty()) add("--eds", options.eds);
  if (!options.device.empty()) add("--device", options.device);
  if (options.node) add("--node", std::to_string(*options.node));
  return out + fmt::format(" --seed {} --actions {}", options.seed, actions);
}

void print_frames(const explore::Finding& finding, NodeId node) {
  const auto& trace = finding.played.trace;
  canopen::Decoder decoder(node);
  constexpr std::size_t most = 24;
  const auto first = trace.size() > most ? trace.size() - most : 0;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const auto& each = trace[i];
    auto meaning = decoder.meaning(each.frame, each.direction);
    if (i < first) continue;
    const auto micros = std::chrono::floor<std::chrono::microseconds>(each.time.time_since_epoch()).count();
    const auto id = each.frame.extended ? hex(each.frame.id, 8) : to_string(CanId(each.frame.id));
    print(fmt::format("  | {:>10.3f} {} {}  {:<23}  {}\n", static_cast<double>(micros) / 1000,
                      each.direction == can::Direction::transmitted ? '>' : '<', id,
                      each.frame.remote ? "remote" : hex_bytes(each.frame.bytes()), meaning));
  }
}

void print_finding(const explore::Finding& finding, const Explorable& device, const ExploreCommand& options,
                   const scenario::Catalogue& catalogue) {
  const auto verdict = word_of(finding, catalogue);
  const auto& assigned = finding.assigned;
  const auto came = explore::came_text(finding, device.words), due = explore::due_text(finding, device.words);
  print(fmt::format("{}: {}: {}{}\n", verdict,
                    assigned ? assigned->requirement : "differs from the model, no rule known", came,
                    due.empty() ? "" : fmt::format(", with the model: {}", due)));
  if (assigned) {
    if (const auto* rule = catalogue.find(assigned->requirement))
      print(fmt::format("  | rule    {}, {}\n  |         {}\n", rule->id, rule->clause, rule->statement));
  }
  std::size_t number = 0;
  for (const auto& action : finding.conversation)
    print(fmt::format("  | {:>2}.     {}\n", ++number, explore::describe(action, device.words.node)));
  print_frames(finding, device.words.node);
  if (finding.is_flaky())
    print(fmt::format("  | flaky   showed again {} of {} times\n", finding.repeated, finding.repeats));
  print(fmt::format("  | again   {}\n\n", again(options, finding.actions_until)));
}

/// What it finds of the reference node's defects, and of what is none.
int prove(const ExploreCommand& options, const std::string& root, const scenario::Catalogue& catalogue) {
  const auto profile = device::load_profile_file(root + "/devices/reference-node.yaml");
  if (!profile) return report_error(profile.error(), exit_usage);
  const auto proof = prove_exploration(profile->profile, catalogue,
                                       {.seed = options.seed,
                                        .only = options.defects,
                                        .combinations = options.combinations,
                                        .actions = options.actions.value_or(20'000),
                                        .jobs = options.jobs});
  if (!proof) return report_error(proof.error(), exit_usage);
  if (proof->defects.empty() && proof->variants.empty())
    return report_error({"no defect is named so", {}, "canopen-refnode --list-defects"}, exit_usage);
  print(exploration_words(*proof, options.verbose));
  return proof->falsely_blamed() == 0 ? 0 : 1;
}

Result<Explorable> explorable(const ExploreCommand& options, const std::string& root) {
  auto known = device_under_test({.profile = options.device, .eds = options.eds, .node = options.node},
                                 {.simulate = true, .variants = options.variants, .suites = root});
  if (!known) return std::unexpected(known.error());
  return explorable_of(known->profile, {options.defects, options.variants, known->description},
                       options.variants);
}

}  // namespace

int explore_command(const ExploreCommand& options) {
  const auto begin = std::chrono::steady_clock::now();
  if (!options.simulate && !options.prove)
    return report_error(
        {"say what to explore", {}, "--simulate; a device on an interface is not explored yet"}, exit_usage);
  const auto budget =
      options.time.empty() ? std::optional(Duration(std::chrono::seconds(10))) : parse_duration(options.time);
  if (!budget)
    return report_error({"'" + options.time + "' is no time", "--for", "10s, 500 ms, 2 min"}, exit_usage);
  auto folders = find_suites(options.suites);
  if (!folders) return report_error(folders.error(), exit_usage);
  auto suites = load_suites(*folders, use_colour("auto", 2));
  if (!suites) return report_error(suites.error(), exit_usage);
  if (options.prove) return prove(options, folders->root, suites->catalogue);
  auto device = explorable(options, folders->root);
  if (!device) return report_error(device.error(), exit_usage);
  note_stop_signals();

  explore::SearchOptions search;
  search.seed = options.seed;
  search.offer = device->offer;
  search.most_findings = options.most_findings;
  // A number of actions is a budget of its own, so that it means the same on every machine.
  search.most_actions = options.actions.value_or(SIZE_MAX);
  if (!options.actions || !options.time.empty()) {
    search.is_over = [&] { return stop_signal != 0 || std::chrono::steady_clock::now() - begin > *budget; };
  } else {
    search.is_over = [] { return stop_signal != 0; };
  }
  search.on_finding = [&](const explore::Finding& finding) {
    if (!options.quiet) print_finding(finding, *device, options, suites->catalogue);
    std::fflush(stdout);
    return false;
  };
  const auto result = explore::search(device->bench, device->words, search);
  if (!result) return report_error(result.error(), exit_environment);
  if (!options.write.empty() && !result->findings.empty()) {
    const auto text =
        explore::scenario_file(result->findings, device->words, again(options, result->actions));
    if (auto written = write_file_atomically(options.write, text); !written)
      return report_error(written.error(), exit_environment);
  }
  // What the model was told of: a reader sees at once whether that is the device on the bench.
  for (const auto& id : result->chosen) print(fmt::format("learnt: the device {}\n", summary_of_choice(id)));
  const auto verdicts = count_words(*result, suites->catalogue);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  print(fmt::format(
      "{} actions in {} conversations, {} more to make findings short; {:.1f} s, {:.0f} actions a second\n"
      "{} violated, {} tolerated, {} without a known rule\n",
      result->actions, result->episodes, result->shrinking, took.count(),
      static_cast<double>(result->actions) / std::max(took.count(), 0.001), verdicts.fail, verdicts.warn,
      verdicts.open));
  if (stop_signal != 0) return 128 + stop_signal;
  if (verdicts.fail > 0) return 1;
  return options.strict && verdicts.open + verdicts.warn > 0 ? exit_environment : 0;
}

}  // namespace conform::cli
