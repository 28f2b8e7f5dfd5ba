// SPDX-License-Identifier: Apache-2.0
// `explore`: looks for what no scenario asks for.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "base/shell_word.hpp"
#include "base/text.hpp"
#include "canopen/decode.hpp"
#include "cli/commands/commands.hpp"
#include "cli/commands/explore_command.hpp"
#include "cli/exploring/live_search.hpp"
#include "cli/exploring/written_findings.hpp"
#include "cli/proof/explained.hpp"
#include "cli/proof/explored.hpp"
#include "cli/proof/explored_mutants.hpp"
#include "cli/run/device_under_test.hpp"
#include "cli/run/stop_signal.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "explore/corpus.hpp"
#include "explore/scenario_text.hpp"
#include "variants/variant.hpp"

namespace conform::cli {
namespace {

/// Of a hundred conversations, those that are made from kept ones. More of them find less than drawn ones do
/// (docs/exploration.md).
constexpr unsigned guided_by_corpus = 25;

/// The command that finds it again, whatever the machine is worth.
std::string again(const ExploreCommand& options, std::size_t actions) {
  std::string out = "canopen-conform explore";
  if (options.simulate) out += " --simulate";
  const auto add = [&](std::string_view option, const std::string& value) {
    out += fmt::format(" {} {}", option, shell_word(value));
  };
  if (!options.interface.empty()) add("--interface", options.interface);
  if (!options.allow.empty()) add("--allow", options.allow);
  for (const auto& id : options.defects) add("--defect", id);
  for (const auto& id : options.variants) add("--variant", id);
  if (!options.eds.empty()) add("--eds", options.eds);
  if (!options.device.empty()) add("--device", options.device);
  if (options.node) add("--node", std::to_string(*options.node));
  if (!options.corpus.empty()) add("--corpus", options.corpus);
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

void print_finding(const explore::Finding& finding, const explore::Vocabulary& words,
                   const ExploreCommand& options, const scenario::Catalogue& catalogue) {
  const auto verdict = word_of(finding, catalogue);
  const auto& assigned = finding.assigned;
  const auto came = explore::came_text(finding, words), due = explore::due_text(finding, words);
  print(fmt::format("{}: {}: {}{}\n", verdict,
                    assigned ? assigned->requirement : "differs from the model, no rule known", came,
                    due.empty() ? "" : fmt::format(", with the model: {}", due)));
  if (assigned) {
    if (const auto* rule = catalogue.find(assigned->requirement))
      print(fmt::format("  | rule    {}, {}\n  |         {}\n", rule->id, rule->clause, rule->statement));
  }
  std::size_t number = 0;
  for (const auto& action : finding.conversation)
    print(fmt::format("  | {:>2}.     {}\n", ++number, explore::describe(action, words.node)));
  print_frames(finding, words.node);
  if (finding.is_flaky())
    print(fmt::format("  | flaky   showed again {} of {} times\n", finding.repeated, finding.repeats));
  print(fmt::format("  | again   {}\n\n", again(options, finding.actions_until)));
}

/// What it finds of the mistakes in the node that `--mutant` names.
int prove_by_mutants(const ExploreCommand& options, const device::Profile& profile,
                     const scenario::Catalogue& catalogue) {
  const auto build = mutants_of_program();
  if (!build) return report_error(build.error(), exit_usage);
  const auto explanations = explanations_of(**build);
  if (!explanations) return report_error(explanations.error(), exit_usage);
  auto only = options.mutants;
  const bool gaps = std::erase(only, "open") > 0;
  std::vector<const Mutant*> mutants;
  for (const auto& mutant : (*build)->mutants) {
    const auto explains = [&mutant](const Explanation& each) { return each.is_gap() && each.is_of(mutant); };
    if ((gaps && std::ranges::any_of(*explanations, explains)) || (!only.empty() && is_named(mutant, only)))
      mutants.push_back(&mutant);
  }
  if (mutants.empty())
    return report_error({"no mutant is named so", {}, "selftest --mutants -v lists them"}, exit_usage);
  const auto found = explore_mutants(
      **build, mutants, profile, catalogue,
      {.seed = options.seed, .actions = options.actions.value_or(20'000), .jobs = options.jobs});
  if (!found) return report_error(found.error(), exit_usage);
  print(explored_mutants_words(*found));
  return 0;
}

/// What it finds of the reference node's defects, and of what is none.
int prove(const ExploreCommand& options, const std::string& root, const scenario::Catalogue& catalogue) {
  const auto profile = device::load_profile_file(root + "/devices/reference-node.yaml");
  if (!profile) return report_error(profile.error(), exit_usage);
  if (!options.mutants.empty()) return prove_by_mutants(options, profile->profile, catalogue);
  const auto proof = prove_exploration(profile->profile, catalogue,
                                       {.seed = options.seed,
                                        .only = options.defects,
                                        .variants = options.variants,
                                        .combinations = options.combinations,
                                        .actions = options.actions.value_or(20'000),
                                        .jobs = options.jobs});
  if (!proof) return report_error(proof.error(), exit_usage);
  if (proof->defects.empty() && proof->variants.empty())
    return report_error(
        {"no defect or variant is named so", {}, "canopen-refnode --list-defects, --list-variants"},
        exit_usage);
  print(exploration_words(*proof, options.verbose));
  return proof->falsely_blamed() == 0 ? 0 : 1;
}

/// Said before the search and not behind it.
Result<void> has_folder(const std::string& file) {
  if (file.empty()) return {};
  const auto folder = std::filesystem::absolute(file).parent_path();
  std::error_code ignored;
  if (std::filesystem::is_directory(folder, ignored)) return {};
  return fail("no such folder", folder.string(), "--write FILE is in a folder that there is");
}

/// What became of the device on the interface: the exit code of that, 0 where it is as it was.
int tell_of_device(const LiveResult& live) {
  int code = 0;
  for (const auto& each : live.left) code = report_error({"not put back: " + each, {}, {}}, exit_environment);
  if (live.lost)
    code = report_error({"nobody could look whether the device holds what it held: " + live.lost->text(),
                         {},
                         "'canopen-conform recover' puts it back"},
                        exit_environment);
  return code;
}

void print_summary(const explore::SearchResult& result, const FoundCounts& verdicts,
                   std::chrono::duration<double> took) {
  // What the model was told of: a reader sees at once whether that is the device on the bench.
  for (const auto& id : result.chosen) print(fmt::format("learnt: the device {}\n", summary_of_choice(id)));
  if (result.passed_by > 0) print(fmt::format("{} differences did not show again\n", result.passed_by));
  if (result.distrusted > 0)
    print(fmt::format("{} conversations say nothing, because the host lost frames or was late\n",
                      result.distrusted));
  print(fmt::format(
      "{} actions in {} conversations, {} more to make findings short; {:.1f} s, {:.0f} actions a second\n"
      "{} violated, {} tolerated, {} without a known rule\n",
      result.actions, result.episodes, result.shrinking, took.count(),
      static_cast<double>(result.actions) / std::max(took.count(), 0.001), verdicts.fail, verdicts.warn,
      verdicts.open));
}

/// How many conversations are new in the corpus. The next search begins with those that found something, so
/// that it says at once what became of it.
Result<std::size_t> keep(const std::string& folder, const explore::SearchResult& result, NodeId node) {
  std::vector<explore::Conversation> found;
  for (const auto& finding : result.findings) found.push_back(finding.conversation);
  const auto first = explore::add_to_corpus(folder, found, node, true);
  if (!first) return std::unexpected(first.error());
  const auto others = explore::add_to_corpus(folder, result.kept, node);
  if (!others) return std::unexpected(others.error());
  return *first + *others;
}

/// What was found in simulation is played there again, also with a right device: the same with what was
/// learnt.
Result<void> write(const ExploreCommand& options, const explore::SearchResult& result,
                   const explore::Vocabulary& words, const device::Profile& profile,
                   const NodeSwitches& switches, const scenario::Catalogue& catalogue) {
  const auto how = again(options, result.actions);
  if (!options.simulate)
    return write_file_atomically(options.write, explore::scenario_file(result.findings, words, how));
  auto right = switches;
  right.defects.clear();
  for (const auto& id : result.chosen) {
    const bool is_new = std::ranges::find(right.variants, id) == right.variants.end();
    if (is_new && refnode::find_variant(id) != nullptr) right.variants.push_back(id);
  }
  const auto written =
      write_findings(options.write, result.findings, words, how, switches, right, profile, catalogue);
  if (!written) return std::unexpected(written.error());
  print(fmt::format("{}: {}\n", options.write, written->text()));
  return {};
}

}  // namespace

int explore_command(const ExploreCommand& options) {
  const auto begin = std::chrono::steady_clock::now();
  const bool live = !options.interface.empty();
  if (!options.simulate && !options.prove && !live)
    return report_error({"say what to explore", {}, "--interface can0 --node 5, or --simulate"}, exit_usage);
  if (live && !options.defects.empty())
    return report_error({"--defect is for the simulated node", {}, "canopen-refnode --defect ID"},
                        exit_usage);
  const auto budget = options.time.empty() ? std::optional(Duration(std::chrono::seconds(live ? 60 : 10)))
                                           : parse_duration(options.time);
  if (!budget)
    return report_error({"'" + options.time + "' is no time", "--for", "10s, 500 ms, 2 min"}, exit_usage);
  if (auto there = has_folder(options.write); !there) return report_error(there.error(), exit_usage);
  auto folders = find_suites(options.suites);
  if (!folders) return report_error(folders.error(), exit_usage);
  auto suites = load_suites(*folders, use_colour("auto", 2));
  if (!suites) return report_error(suites.error(), exit_usage);
  if (options.prove) return prove(options, folders->root, suites->catalogue);
  auto known = device_under_test({.profile = options.device, .eds = options.eds, .node = options.node},
                                 {.simulate = !live, .variants = options.variants, .suites = folders->root});
  if (!known) return report_error(known.error(), exit_usage);
  note_stop_signals();

  explore::SearchOptions search;
  search.seed = options.seed;
  search.most_findings = options.most_findings;
  // A number of actions is a budget of its own, so that it means the same on every machine.
  search.most_actions = options.actions.value_or(SIZE_MAX);
  if (!options.actions || !options.time.empty()) {
    search.is_over = [&] { return stop_signal != 0 || std::chrono::steady_clock::now() - begin > *budget; };
  } else {
    search.is_over = [] { return stop_signal != 0; };
  }
  explore::Vocabulary words;
  search.on_finding = [&](const explore::Finding& finding) {
    if (!options.quiet) print_finding(finding, words, options, suites->catalogue);
    std::fflush(stdout);
    return false;
  };

  explore::SearchResult result;
  NodeSwitches switches;
  std::size_t conversations_read = 0;
  int code = 0;
  if (live) {
    auto found =
        explore_live(options, folders->root, std::move(*known), std::move(search),
                     [&](const Explorable& device, NodeId node, steps::Tier allowed) {
                       words = device.words;
                       if (options.quiet) return;
                       print(fmt::format("node {} on {}, {}: {} entries to talk about\n\n", node.value(),
                                         options.interface, steps::word_of(allowed), words.entries.size()));
                       std::fflush(stdout);
                     });
    if (!found) return report_end(found.error(), exit_environment);
    result = std::move(found->search);
    code = tell_of_device(*found);
    if (result.ended_by && stop_signal == 0) code = report_error(*result.ended_by, exit_environment);
  } else {
    switches = {options.defects, options.variants, known->description};
    auto device = explorable_of(known->profile, switches, options.variants);
    if (!device) return report_error(device.error(), exit_usage);
    words = device->words;
    search.offer = device->offer;
    if (!options.corpus.empty()) {
      auto corpus = explore::read_corpus(options.corpus, words.node);
      if (!corpus) return report_error(corpus.error(), exit_usage);
      conversations_read = corpus->size();
      search.corpus = std::move(*corpus);
      search.guided = guided_by_corpus;
    }
    auto found = explore::search(device->bench, device->words, search);
    if (!found) return report_error(found.error(), exit_environment);
    result = std::move(*found);
  }
  const auto verdicts = count_words(result, suites->catalogue);
  print_summary(result, verdicts, std::chrono::steady_clock::now() - begin);
  if (!options.corpus.empty()) {
    const auto added = keep(options.corpus, result, words.node);
    if (!added) return report_error(added.error(), exit_environment);
    print(fmt::format("{}: {} conversations read, {} added; {} states reached\n", options.corpus,
                      conversations_read, *added, result.states));
  }
  if (!options.write.empty() && !result.findings.empty()) {
    if (auto written = write(options, result, words, known->profile, switches, suites->catalogue); !written)
      return report_error(written.error(), exit_environment);
  }
  if (stop_signal != 0) return 128 + stop_signal;
  if (verdicts.fail > 0) return 1;
  if (code != 0) return code;
  return options.strict && verdicts.open + verdicts.warn > 0 ? exit_environment : 0;
}

}  // namespace conform::cli
