// SPDX-License-Identifier: Apache-2.0
// `selftest`: the suite proves itself, part by part.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/files.hpp"
#include "base/text.hpp"
#include "base/time.hpp"
#include "cli/commands/commands.hpp"
#include "cli/pages/proof_page.hpp"
#include "cli/pages/proof_words.hpp"
#include "cli/proof/within_budget.hpp"
#include "cli/proof/worth.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "device/profile.hpp"
#include "result/pattern_file.hpp"

namespace conform::cli {
namespace {

/// One cause, and the right one, for each defect; those that show otherwise by name.
constexpr double least_share = 0.95;

bool is_blamed_well(const std::vector<Blame>& blames) {
  const auto right = std::ranges::count_if(blames, &Blame::single_and_right);
  return static_cast<double>(right) >= least_share * static_cast<double>(blames.size());
}

/// The command line that gives the same page, without the names of files.
std::string command_of(const SelftestCommand& options) {
  std::string out = options.mutants ? "canopen-conform-mutants selftest" : "canopen-conform selftest";
  const auto add = [&](bool is_asked, std::string_view words) {
    if (is_asked) out += fmt::format(" {}", words);
  };
  for (const auto& id : options.defects) add(true, "--defect " + id);
  add(options.full, "--full");
  add(options.whole, "--whole");
  add(options.blame && !options.full, "--blame");
  add(options.pairs > 0, fmt::format("--pairs {}", options.pairs));
  add(options.variants, "--variants");
  add(options.edits, "--edits");
  add(options.mutants, "--mutants");
  for (const auto& name : options.mutant) add(true, "--mutant " + name);
  add(options.sample > 0, fmt::format("--sample {}", options.sample));
  add(options.quick, "--quick");
  add(options.seed != 1, fmt::format("--seed {}", options.seed));
  return out + " --html proof.html";
}

Result<void> write_unless_empty(const std::string& path, const std::string& text) {
  return path.empty() ? Result<void>{} : write_file_atomically(path, text);
}

/// What one part makes of the exit code, or an exit code that ends it all.
struct Step {
  int code = 0;
  bool ends = false;
};
Step end_with(int code) { return {code, true}; }

/// What the parts are about.
struct Material {
  const device::Profile& profile;
  const LoadedSuites& suites;
  std::vector<result::Pattern> known;  ///< of defects, by which reports name them
};

/// The files of suites/patterns that are asked for.
Result<void> write_patterns(const SelftestCommand& options, const Material& of,
                            const std::vector<Blame>& blames) {
  if (!options.patterns.empty()) {
    if (auto written = write_file_atomically(options.patterns, result::pattern_file(patterns_of(blames)));
        !written)
      return written;
  }
  if (options.worth.empty()) return {};
  const auto worths = worths_of(of.profile, of.suites.suite, of.suites.catalogue, blames, options.seed);
  if (!worths) return std::unexpected(worths.error());
  return write_file_atomically(options.worth, result::worth_file(*worths));
}

/// suites/patterns, without the kill matrix.
int patterns(const SelftestCommand& options, const Material& of) {
  const auto blames = blames_of_defects(
      of.profile, of.suites.suite, of.suites.catalogue,
      {.seed = options.seed, .only = options.defects, .known = of.known, .jobs = options.jobs});
  if (!blames) return report_error(blames.error(), exit_usage);
  if (blames->empty())
    return report_error({"no defect is named so", {}, "canopen-refnode --list-defects"}, exit_usage);
  print(recognised_words(*blames, options.verbose));
  print(fmt::format("{} patterns\n", patterns_of(*blames).size()));
  const auto written = write_patterns(options, of, *blames);
  return written ? 0 : report_error(written.error(), exit_environment);
}

int budget(const SelftestCommand& options, const Material& of, const std::string& root) {
  const auto time = parse_duration(options.budget);
  if (!time) return report_error({"'" + options.budget + "' is no time", {}, "--budget '60 s'"}, exit_usage);
  const auto worths = load_worths(root);
  if (!worths) return report_error(worths.error(), exit_usage);
  const auto within = within_budget(of.profile, of.suites.suite, of.suites.catalogue, *worths, *time,
                                    {.seed = options.seed, .only = options.defects, .jobs = options.jobs});
  if (!within) return report_error(within.error(), exit_usage);
  if (within->defects == 0)
    return report_error({"no defect is named so", {}, "canopen-refnode --list-defects"}, exit_usage);
  print(budget_words(*within, options.verbose));
  return within->ok() ? 0 : 1;
}

Step defects(const SelftestCommand& options, const Material& of, Proof& proof) {
  const bool blame = options.blame || options.full;
  auto matrix = kill_matrix(of.profile, of.suites.suite, of.suites.catalogue,
                            {.seed = options.seed,
                             .only = options.defects,
                             .whole = options.whole,
                             .blame = blame,
                             .pairs = options.pairs,
                             .known = of.known,
                             .jobs = options.jobs});
  if (!matrix) return end_with(report_error(matrix.error(), exit_usage));
  std::string out = matrix_words(*matrix, options.verbose, !options.defects.empty());
  if (blame) out += blame_words(matrix->blames, options.verbose);
  if (!matrix->blames.empty()) out += recognised_words(matrix->blames, options.verbose);
  if (options.pairs > 0) out += pair_words(matrix->pairs);
  print(out);
  if (const auto written = write_unless_empty(options.markdown, proof_markdown(*matrix)); !written)
    return end_with(report_error(written.error(), exit_environment));
  if (const auto written = write_unless_empty(options.blame_page, blame_page(*matrix)); !written)
    return end_with(report_error(written.error(), exit_environment));
  if (const auto written = write_patterns(options, of, matrix->blames); !written)
    return end_with(report_error(written.error(), exit_environment));
  const bool is_well = matrix->ok() && (!blame || !options.defects.empty() || is_blamed_well(matrix->blames));
  proof.has_blame = blame;
  proof.matrix = std::move(*matrix);
  return {is_well ? 0 : 1};
}

Step legal_variants(const SelftestCommand& options, const Material& of, Proof& proof) {
  auto variants = variants_alone(of.suites, of.profile, options.seed, options.jobs);
  if (!variants) return end_with(report_error(variants.error(), exit_usage));
  print(variant_words(*variants, options.verbose));
  const bool is_well =
      std::ranges::all_of(*variants, [](const VariantVerdict& each) { return each.complaints.empty(); });
  proof.variants = std::move(*variants);
  return {is_well ? 0 : 1};
}

Step edits(const SelftestCommand& options, const Material& of, Proof& proof) {
  auto matrix = edit_matrix(of.profile, of.suites.suite, of.suites.catalogue, options.seed, options.jobs,
                            options.defects);
  if (!matrix) return end_with(report_error(matrix.error(), exit_usage));
  print(edit_words(*matrix, options.verbose));
  const bool is_well = matrix->survivors().empty();
  proof.edits = std::move(*matrix);
  return {is_well ? 0 : 1};
}

Result<void> throughput(Proof& proof) {
  constexpr std::uint32_t bit_rate = 1'000'000;
  constexpr std::size_t transfers = 500, segmented = 20'000, block = 200'000;
  using enum TransferKind;
  for (const auto& [kind, amount] :
       {std::pair(expedited_upload, transfers), std::pair(expedited_download, transfers),
        std::pair(segmented_upload, segmented), std::pair(segmented_download, segmented),
        std::pair(block_upload, block), std::pair(block_download, block)}) {
    const auto measured = measure_simulated(kind, bit_rate, amount);
    if (!measured) return std::unexpected(measured.error());
    proof.throughput.emplace_back(kind, *measured);
  }
  return {};
}

}  // namespace

int selftest_command(const SelftestCommand& options) {
  auto root = find_suites(options.suites);
  if (!root) return report_error(root.error(), exit_usage);
  auto suites = load_suites(*root, false);
  if (!suites) return report_error(suites.error(), exit_usage);
  auto profile = device::load_profile_file(root->root + "/devices/reference-node.yaml");
  if (!profile) return report_error(profile.error(), exit_usage);
  auto known = load_patterns(root->root);
  if (!known) return report_error(known.error(), exit_usage);
  const Material of{profile->profile, *suites, std::move(*known)};
  if (!options.budget.empty()) return budget(options, of, root->root);
  const bool instead = options.variants || options.edits || options.mutants;
  if (!(options.patterns.empty() && options.worth.empty()) && !options.blame && !options.full && !instead)
    return patterns(options, of);
  // What takes minutes is not lost in the end: the page says that it is not ready until it is.
  if (const auto tried = write_unless_empty(options.html, "the selftest has not ended\n"); !tried)
    return report_error(tried.error(), exit_environment);
  Proof proof;
  proof.tool = "canopen-conform " CONFORM_VERSION;
  proof.command = command_of(options);
  proof.started_utc_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(
                             std::chrono::system_clock::now().time_since_epoch())
                             .count();
  proof.seed = options.seed;
  proof.suites = suite_properties(*root);
  proof.catalogue = &suites->catalogue;
  proof.is_part = !options.defects.empty() || !options.mutant.empty() || options.sample > 0;
  struct Part {
    bool is_asked;
    Step (*run)(const SelftestCommand&, const Material&, Proof&);
  };
  int code = 0;
  for (const auto& part :
       {Part{!instead || options.full, defects}, Part{options.variants || options.full, legal_variants},
        Part{options.edits || options.full, edits}}) {
    if (!part.is_asked) continue;
    const auto step = part.run(options, of, proof);
    if (step.ends) return step.code;
    code = std::max(code, step.code);
  }
  if (options.mutants) {
    const auto mutants = mutants_command(options, profile->profile, *suites, proof);
    if (mutants > 1) return mutants;
    code = std::max(code, mutants);
  }
  if (options.html.empty()) return code;
  if (const auto measured = throughput(proof); !measured)
    return report_error(measured.error(), exit_environment);
  proof.exit_code = code;
  const auto written = write_file_atomically(options.html, proof_page(proof));
  return written ? code : report_error(written.error(), exit_environment);
}

}  // namespace conform::cli
