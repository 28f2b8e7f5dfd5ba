// SPDX-License-Identifier: Apache-2.0
// Reports in GitHub's Markdown.
#pragma once

#include <cstddef>
#include <string>

#include "reports/beside.hpp"
#include "result/run_result.hpp"

namespace conform::reports {

/// For the summary of a CI job and comments on pull requests, at most 60 lines: verdict, causes, the areas in
/// which something did not pass, and where the rest stands.
[[nodiscard]] std::string markdown(const result::RunResult& run, const Beside& beside = {});

struct MarkdownOptions {
  /// GitHub refuses the summary of a step above 1 MiB; what does not fit is counted instead of shown.
  std::size_t size_limit = 900'000;
};

/// Everything for a wiki page: table by area, failures and warnings with their frames folded, what was not
/// judged and why.
[[nodiscard]] std::string markdown_evidence(const result::RunResult& run, const Beside& beside = {},
                                            const MarkdownOptions& options = {});

}  // namespace conform::reports
