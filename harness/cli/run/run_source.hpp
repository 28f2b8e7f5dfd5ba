// SPDX-License-Identifier: Apache-2.0
// A run that is over, as a command is given it: its result.json or its journal.
#pragma once

#include <string>

#include "base/error.hpp"
#include "journal/writer.hpp"
#include "result/run_result.hpp"

namespace conform::cli {

struct RunSource {
  result::RunResult run;
  journal::ReportPaths reports{};  ///< those that the run was asked for; a result does not know them
  std::string profile{}, eds{};    ///< as absolute paths, where it is a journal
};

/// Error: a file that cannot be read, or is neither.
[[nodiscard]] Result<RunSource> read_run(const std::string& path);
/// To hold other runs against it: an error as well where it has no cases, as a file that says that its run
/// has not ended.
[[nodiscard]] Result<RunSource> read_run_with_cases(const std::string& path);
/// The same, of which only what was found counts.
[[nodiscard]] Result<result::RunResult> read_run_to_compare(const std::string& path);

}  // namespace conform::cli
