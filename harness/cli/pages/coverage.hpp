// SPDX-License-Identifier: Apache-2.0
// Which rules of the catalogue are judged, by what, and what is left out and why.
#pragma once

#include <string>
#include <vector>

#include "cli/suite_folder.hpp"
#include "scenario/catalogue.hpp"

namespace conform::cli {

/// One rule and what there is about it.
struct CoveredRule {
  const scenario::Requirement* requirement = nullptr;
  std::vector<std::string> scenarios;  ///< ids, in the order of the suites; monitors come last
  std::vector<std::string> defects;    ///< ids of the reference node's defects that violate it
  [[nodiscard]] bool judged() const { return !scenarios.empty(); }
  /// Why nothing judges it; empty when the catalogue gives no reason, which means that it is still to come.
  [[nodiscard]] const std::string& reason() const { return requirement->not_judged; }
};

/// Every rule of the catalogue, in file order.
[[nodiscard]] std::vector<CoveredRule> coverage(const LoadedSuites& suites);

/// docs/coverage.md
[[nodiscard]] std::string coverage_page(const std::vector<CoveredRule>& rules);
/// One line per area for the terminal.
[[nodiscard]] std::string coverage_summary(const std::vector<CoveredRule>& rules);

}  // namespace conform::cli
