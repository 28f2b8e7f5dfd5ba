// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "base/files.hpp"
#include "cli/commands/commands.hpp"
#include "cli/pages/mutants_page.hpp"
#include "cli/pages/proof_page.hpp"
#include "cli/proof/explained.hpp"
#include "cli/proof/mutants.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "device/profile.hpp"

namespace conform::cli {
namespace {

/// Percent of the mutants that can be noticed, and of those that still run as a node by a failure.
constexpr double least_noticed = 97.0;
constexpr double least_failed = 93.0;

}  // namespace

int mutants_command(const SelftestCommand& options, const device::Profile& profile,
                    const LoadedSuites& suites, Proof& proof) {
  const auto mutants = mutants_of_program();
  if (!mutants) return report_error(mutants.error(), exit_usage);
  const auto* build = *mutants;
  const auto explanations = explanations_of(*build);
  if (!explanations) return report_error(explanations.error(), exit_usage);
  const bool shows_progress = ::isatty(STDERR_FILENO) != 0;
  const auto progress = [&](std::size_t done, std::size_t of) {
    if (shows_progress) std::fprintf(stderr, "\r%zu of %zu", done, of);
  };
  auto fates = run_mutants(*build, profile, suites.suite, suites.catalogue,
                           {.seed = options.seed,
                            .only = options.mutant,
                            .sample = options.sample,
                            .jobs = options.jobs,
                            .slow = !options.quick,
                            .progress = progress});
  if (!fates) return report_error(fates.error(), exit_environment);
  if (shows_progress) std::fputs("\r", stderr);
  const auto stale = explain(*fates, build->mutants, *explanations);
  auto out = mutants_words(*fates, options.verbose);
  for (const auto& line : stale) out += fmt::format("STALE {}: {}\n", build->explained, line);
  out += fmt::format("{} places could not be mutated: the compiler refused\n", build->dropped);
  print(out);
  // With everything else, that is the page of the defects.
  if (!options.markdown.empty() && !options.full) {
    const auto written = write_file_atomically(options.markdown, mutants_page(*fates));
    if (!written) return report_error(written.error(), exit_environment);
  }
  const auto score = score_of(*fates);
  const bool enough = score.share_noticed() >= least_noticed && score.share_failed() >= least_failed;
  proof.stale = stale;
  proof.mutants = std::move(*fates);
  return enough && proof.stale.empty() ? 0 : 1;
}

}  // namespace conform::cli
