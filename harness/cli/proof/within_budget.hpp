// SPDX-License-Identifier: Apache-2.0
// What a run with a budget finds: which of the defects a short look at a device would have told of.
#pragma once

#include <string>
#include <vector>

#include "base/time.hpp"
#include "cli/proof/selftest.hpp"
#include "result/worth.hpp"

namespace conform::cli {

struct WithinBudget {
  Duration budget{};
  std::size_t defects = 0;          ///< how many were tried
  std::vector<std::string> missed;  ///< those that no case told of, by a failure or a warning
  std::size_t complaints = 0;       ///< of the conformant node: cases that failed or warned

  [[nodiscard]] std::size_t found() const { return defects - missed.size(); }
  /// At least four of five, and the conformant node is not failed.
  [[nodiscard]] bool ok() const { return 5 * found() >= 4 * defects && complaints == 0; }
};

/// A run of `budget` on the simulated bus for each defect, and one for none.
[[nodiscard]] Result<WithinBudget> within_budget(const device::Profile& profile, const scenario::Suite& suite,
                                                 const scenario::Catalogue& catalogue,
                                                 const result::Worths& worths, Duration budget,
                                                 const KillOptions& options);

/// For a terminal; `verbose`: also which were missed.
[[nodiscard]] std::string budget_words(const WithinBudget& within, bool verbose);

}  // namespace conform::cli
