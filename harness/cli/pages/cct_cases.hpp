// SPDX-License-Identifier: Apache-2.0
// The cases of CiA's conformance test tool, to compare with: who passed there wants to see them here.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/catalogue.hpp"
#include "scenario/loader.hpp"
#include "scenario/selection.hpp"

namespace conform::cli {

struct CctCase {
  std::string_view group;
  std::string_view number;  ///< "2.10" is another one than "2.1"
  std::string_view title;
};
/// In the order of the tool.
[[nodiscard]] std::span<const CctCase> cct_cases();

/// The numbers of the cases that a scenario corresponds to: those that it names itself, and those that only
/// its requirements name.
class CctNumbers {
 public:
  explicit CctNumbers(const scenario::Suite& suite);
  [[nodiscard]] std::set<std::string> of(const scenario::Scenario& scenario,
                                         const scenario::Catalogue& catalogue) const;

 private:
  std::set<std::string> marked_;  ///< cases that some scenario names by itself
};

/// Ids of the chosen scenarios by the number of each case that they correspond to, in the order of the suite.
[[nodiscard]] std::map<std::string, std::vector<std::string>, std::less<>> scenarios_by_case(
    const scenario::Suite& suite, const scenario::Catalogue& catalogue, const scenario::Selection& selection);

/// What `list --cct` prints: every case with the scenarios and rules that correspond, what has no
/// counterpart here, and what of ours has no case there. A selection leaves only the cases that a chosen
/// scenario corresponds to. Empty when there are none.
[[nodiscard]] std::string cct_page(const scenario::Suite& suite, const scenario::Catalogue& catalogue,
                                   const scenario::Selection& selection, bool everything);

}  // namespace conform::cli
