// SPDX-License-Identifier: Apache-2.0
// Whom a run blames: with one fault in the device, there should be one cause, and a rule that the fault
// breaks.
#pragma once

#include <string>
#include <vector>

#include "cli/verdicts.hpp"

namespace conform::cli {

/// `violates`: canonical ids.
[[nodiscard]] Result<Blame> blame_of(const std::string& defect, const std::vector<std::string>& violates,
                                     const Bench& bench);

}  // namespace conform::cli
