// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/within_budget.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/in_parallel.hpp"
#include "base/text.hpp"
#include "defects/defect.hpp"

namespace conform::cli {
Result<WithinBudget> within_budget(const device::Profile& profile, const scenario::Suite& suite,
                                   const scenario::Catalogue& catalogue, const result::Worths& worths,
                                   Duration budget, const KillOptions& options) {
  const auto complaints = [&](const std::vector<std::string>& defects) -> Result<std::size_t> {
    engine::RunOptions run;
    run.budget = budget;
    run.plan.worths = &worths;
    const auto done = simulate({defects}, profile, suite, catalogue, std::move(run), options.seed);
    if (!done) return std::unexpected(done.error());
    const auto counts = done->result.counts();
    return counts.fail + counts.warn;
  };
  WithinBudget out;
  out.budget = budget;
  const auto of_none = complaints({});
  if (!of_none) return std::unexpected(of_none.error());
  out.complaints = *of_none;
  const auto rows = chosen_rows(options.only);
  const auto of_each = all_in_parallel(rows.size(), options.jobs,
                                       [&](std::size_t i) { return complaints({std::string(rows[i]->id)}); });
  if (!of_each) return std::unexpected(of_each.error());
  out.defects = rows.size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if ((*of_each)[i] == 0) out.missed.emplace_back(rows[i]->id);
  }
  return out;
}

std::string budget_words(const WithinBudget& within, bool verbose) {
  std::string out = fmt::format(
      "a run of {} finds {} of {} defects ({:.1f} %), and {} cases of the conformant node fail or warn\n",
      to_string(within.budget), within.found(), within.defects,
      100.0 * static_cast<double>(within.found()) /
          static_cast<double>(std::max<std::size_t>(within.defects, 1)),
      within.complaints);
  if (verbose) {
    for (const auto& id : within.missed) out += "  missed: " + id + "\n";
  }
  return out;
}

}  // namespace conform::cli
