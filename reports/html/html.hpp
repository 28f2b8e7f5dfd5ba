// SPDX-License-Identifier: Apache-2.0
// The run as one page for a browser: opened from an e-mail, printed to PDF, read without JavaScript.
#pragma once

#include <string>

#include "result/run_result.hpp"

namespace conform::reports {

/// A document that needs nothing but itself: style, script and drawings are in it, its policy forbids the
/// network, and it is well-formed XML. Causes, requirements and cases are linked to each other.
[[nodiscard]] std::string html_report(const result::RunResult& run);

}  // namespace conform::reports
