// SPDX-License-Identifier: Apache-2.0
// Whom a run blames: with one fault in the device, there should be one cause, and a rule that the fault
// breaks; with two faults of different parts of it, two.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/proof/verdicts.hpp"

namespace conform::cli {

/// Runs the whole suite against the defect. `known`: patterns that its causes are compared with.
[[nodiscard]] Result<Blame> blame_of(const DefectVerdict& defect, const Bench& bench,
                                     std::span<const result::Pattern> known);

/// Two defects whose runs alone show different parts of the device and are told rightly.
struct PairOfDefects {
  Blame first, second;
};
/// Up to `count` such pairs, by chance.
[[nodiscard]] std::vector<PairOfDefects> pairs_of(const std::vector<Blame>& blames, std::size_t count,
                                                  std::uint64_t seed);

/// What a run against both shows.
[[nodiscard]] Result<PairBlame> blame_of(const PairOfDefects& pair, const Bench& bench);

/// Why a defect does not show one cause with a right rule, where that is known and meant to stay so.
[[nodiscard]] std::optional<std::string_view> reason_of_blame(std::string_view defect);

}  // namespace conform::cli
