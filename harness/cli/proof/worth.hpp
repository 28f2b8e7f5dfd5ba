// SPDX-License-Identifier: Apache-2.0
// What each case of the suites is worth: which defects of the reference node it finds, in how much time.
#pragma once

#include <span>
#include <vector>

#include "cli/proof/selftest.hpp"
#include "result/worth.hpp"

namespace conform::cli {

/// The cases that the conformant node can play, in the order in which a run that must end early should play
/// them: at each place what finds the most defects per time that nothing before it finds; then what judges a
/// requirement that nothing before it judges, the short ones first; then the rest, likewise. A case takes the
/// time that it takes where this order has it. What several cases need, the first of them pays for: a value
/// of 40 KiB is read before the first case that might change it.
[[nodiscard]] Result<std::vector<result::Worth>> worths_of(const device::Profile& profile,
                                                           const scenario::Suite& suite,
                                                           const scenario::Catalogue& catalogue,
                                                           std::span<const Blame> blames, std::uint64_t seed);

}  // namespace conform::cli
