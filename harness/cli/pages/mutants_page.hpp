// SPDX-License-Identifier: Apache-2.0
// What became of the mutants, in words: on the terminal, and docs/mutants.md.
#pragma once

#include <string>
#include <vector>

#include "cli/proof/mutants.hpp"

namespace conform::cli {

/// How many of a group ended how. Equivalent mutants, those that break no rule and those that no run reaches
/// say nothing about the suite: `judged` are the others. One that crashes or hangs is noticed as what it is;
/// it runs no suite to its end, so that the share of failures is of those that still are a node.
struct MutantScore {
  std::size_t all = 0, not_reached = 0, explained = 0, judged = 0;
  std::size_t killed = 0, crashed = 0, hung = 0, noticed = 0, survived = 0;

  void add(const MutantFate& fate);
  [[nodiscard]] double share_noticed() const;
  [[nodiscard]] double share_failed() const;
};

/// Of all of them.
[[nodiscard]] MutantScore score_of(const std::vector<MutantFate>& fates);

/// Score by room and by operator, then who survived: one line each, as it would begin in explained.txt.
[[nodiscard]] std::string mutants_words(const std::vector<MutantFate>& fates, bool verbose);
[[nodiscard]] std::string mutants_page(const std::vector<MutantFate>& fates);

}  // namespace conform::cli
