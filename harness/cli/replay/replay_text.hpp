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

/// "21 of 23 exchanges are the same, 2 differ; 1 kind of frames that come unasked differs".
[[nodiscard]] std::string replay_summary(const ReplayComparison& comparison);

}  // namespace conform::cli
