// SPDX-License-Identifier: Apache-2.0
// Findings about device descriptions in the forms that people and tools read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "eds/lint.hpp"

namespace conform::cli {

/// One file that was looked at; either a report or the reason why there is none.
struct EdsLinted {
  std::string file;   ///< as the user wrote it
  std::string kind;   ///< "EDS", "DCF"...
  std::string bytes;  ///< the file's, to quote its lines
  eds::LintReport report;
  std::optional<Error> unreadable;
};

/// "file:line:column: error[EDS254]: message; hint" for each, with the line of the file below, and the
/// totals.
[[nodiscard]] std::string eds_lint_text(const std::vector<EdsLinted>& files, bool colour);
[[nodiscard]] std::string eds_lint_json(const std::vector<EdsLinted>& files);
/// Workflow commands of GitHub Actions: annotations at the lines of a pull request.
[[nodiscard]] std::string eds_lint_github(const std::vector<EdsLinted>& files);
/// SARIF 2.1.0, as code scanning services read it.
[[nodiscard]] std::string eds_lint_sarif(const std::vector<EdsLinted>& files);

}  // namespace conform::cli
