// SPDX-License-Identifier: Apache-2.0
// The causes of a run where reviewers look: at lines of the change.
#pragma once

#include <string>
#include <string_view>

#include "result/run_result.hpp"

namespace conform::reports {

/// GitLab's code quality report: an issue per cause, with a fingerprint that stays the same from run to run.
[[nodiscard]] std::string code_quality(const result::RunResult& run);

/// Text of a workflow command of GitHub Actions, or of one of its properties.
[[nodiscard]] std::string github_text(std::string_view text, bool property);

/// Workflow commands of GitHub Actions, one line per cause: `::error
/// file=...,line=...,title=OD-1003-06::...`.
[[nodiscard]] std::string github_annotations(const result::RunResult& run);

}  // namespace conform::reports
