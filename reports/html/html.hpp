// SPDX-License-Identifier: Apache-2.0
// The run as one page for a browser: opened from an e-mail, printed to PDF, read without JavaScript.
#pragma once

#include <string>
#include <string_view>

#include "reports/beside.hpp"
#include "result/run_result.hpp"

namespace conform::reports {

/// A document that needs nothing but itself: style, script and drawings are in it, its policy forbids the
/// network, and it is well-formed XML. Causes, requirements and cases are linked to each other, and a cause
/// to its capture where one was written.
[[nodiscard]] std::string html_report(const result::RunResult& run, const Beside& beside = {});

/// Whether a page is the html_report() of this run, whatever lies beside it: of its device, tool and time,
/// and each requirement stands on it with its verdict. Then a link to a requirement in it leads where it
/// should.
[[nodiscard]] bool is_html_report_of(std::string_view page, const result::RunResult& run);

}  // namespace conform::reports
