// SPDX-License-Identifier: Apache-2.0
// One row per requirement, for spreadsheets and traceability.
#pragma once

#include <string>

#include "result/run_result.hpp"

namespace conform::reports {

/// RFC 4180 with a header line: requirement, level, clause, area, verdict, cases that judged it, the first of
/// the worst of them, what decided it there, reason of a waiver. No cell begins with what a spreadsheet takes
/// for a formula.
[[nodiscard]] std::string requirements_csv(const result::RunResult& run);

}  // namespace conform::reports
