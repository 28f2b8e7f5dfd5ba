// SPDX-License-Identifier: Apache-2.0
// Why a mutant may survive: reference-node/mutants/explained.txt.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "cli/proof/mutants.hpp"

namespace conform::cli {

/// A line of the file, "sdo/crc.cpp sdo_crc `i < 8` -> `i <= 8` equivalent: ...". It names a place by its
/// words, so that it stays right when lines move; `*` stands for any.
struct Explanation {
  int line = 0;
  std::string file, function, original, mutated, reason;

  [[nodiscard]] bool is_of(const Mutant& mutant) const;
  /// A gap of the suite that is known; the others cannot be seen, or break no rule.
  [[nodiscard]] bool is_gap() const { return reason.starts_with("open:"); }
  /// Whether one of this fate needs the reason.
  [[nodiscard]] bool explains(Fate fate) const;
};

[[nodiscard]] Result<std::vector<Explanation>> parse_explanations(std::string_view text);

/// Those of a build.
[[nodiscard]] Result<std::vector<Explanation>> explanations_of(const MutantBuild& build);

/// Gives survivors their reasons, and those without a rule (another legal device) also when they are noticed
/// without a failure. Returns the lines that explain nobody: of `all` no mutant is meant, or every one that
/// is meant was run and needs no reason.
[[nodiscard]] std::vector<std::string> explain(std::vector<MutantFate>& fates, std::span<const Mutant> all,
                                               const std::vector<Explanation>& explanations);

/// How the line of a mutant begins.
[[nodiscard]] std::string explanation_key(const Mutant& mutant);

}  // namespace conform::cli
