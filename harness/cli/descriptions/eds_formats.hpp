// SPDX-License-Identifier: Apache-2.0
// Findings about device descriptions in the forms that people and tools read.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "eds/lint.hpp"
#include "eds/lint_fix.hpp"

namespace conform::cli {

/// One file that was looked at; either a report or the reason why there is none.
struct EdsLinted {
  std::string file;   ///< as the user wrote it
  std::string kind;   ///< "EDS", "DCF"...
  bool xml = false;   ///< it is XDD or XDC
  std::string bytes;  ///< the file's, to quote its lines
  eds::LintReport report;
  std::size_t known = 0;                       ///< taken out by a baseline
  std::vector<std::string> gone;               ///< known, but not found any more
  std::vector<std::optional<eds::Fix>> fixes;  ///< of each finding; empty when nobody asked
  std::optional<Error> unreadable;
};

/// "file:line:column: error[EDS254]: message; hint" for each, with the line of the file below, and the
/// totals. Of findings that are alike the first is shown and the others are counted, unless `all`.
[[nodiscard]] std::string eds_lint_text(const std::vector<EdsLinted>& files, bool all, bool colour);
[[nodiscard]] std::string eds_lint_json(const std::vector<EdsLinted>& files);
/// Workflow commands of GitHub Actions: annotations at the lines of a pull request.
[[nodiscard]] std::string eds_lint_github(const std::vector<EdsLinted>& files);
/// SARIF 2.1.0, as code scanning services read it. `rules_uri` is where docs/eds-lint.md is to be found, or
/// empty: then rules have no helpUri, but their help all the same.
[[nodiscard]] std::string eds_lint_sarif(const std::vector<EdsLinted>& files, const std::string& rules_uri);
/// A relative reference or a file URI (RFC 3986); every byte that is not unreserved or a slash is escaped.
[[nodiscard]] std::string file_uri(std::string_view path);
/// "2 files, 1 error, 0 warnings, 3 notes", and what was not told: allowed, known, not readable.
[[nodiscard]] std::string eds_lint_totals(const std::vector<EdsLinted>& files);

}  // namespace conform::cli
