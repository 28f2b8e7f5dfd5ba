// SPDX-License-Identifier: Apache-2.0
// A short report in GitHub's Markdown: for the summary of a CI job and comments on pull requests.
#pragma once

#include <cstddef>
#include <string>

#include "result/run_result.hpp"

namespace conform::reports {

struct MarkdownOptions {
  /// GitHub refuses the summary of a step above 1 MiB; what does not fit is counted instead of shown.
  std::size_t size_limit = 900'000;
};

/// Verdict, table by area, failures and warnings with their frames folded, what was not judged.
[[nodiscard]] std::string markdown(const result::RunResult& run, const MarkdownOptions& options = {});

}  // namespace conform::reports
