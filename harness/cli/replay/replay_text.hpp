// SPDX-License-Identifier: Apache-2.0
// A replay in words, for the terminal.
#pragma once

#include <string>

#include "cli/replay/differences.hpp"
#include "reports/console.hpp"

namespace conform::cli {

/// Every exchange under the step it belongs to, then what came unasked. `quiet`: only what differs. Long
/// stretches without a difference are counted.
[[nodiscard]] std::string replay_text(const ReplayComparison& comparison, const Side& then, const Side& now,
                                      const reports::Style& style, bool quiet);

/// "same: 23 frames with the same answers", "differs: 2 of 23 frames answered otherwise; 1 kind of frames
/// that come unasked differs", or that nothing was compared.
[[nodiscard]] std::string replay_summary(const ReplayComparison& comparison);

}  // namespace conform::cli
