// SPDX-License-Identifier: Apache-2.0
// The run as one page for a browser: opened from an e-mail, printed to PDF, read without JavaScript.
#pragma once

#include <string>

#include "reports/beside.hpp"
#include "result/run_result.hpp"

namespace conform::reports {

/// A document that needs nothing but itself: style, script and drawings are in it, its policy forbids the
/// network, and it is well-formed XML. Causes, requirements and cases are linked to each other, and a cause
/// to its capture where one was written.
[[nodiscard]] std::string html_report(const result::RunResult& run, const Beside& beside = {});

}  // namespace conform::reports
