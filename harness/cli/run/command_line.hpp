// SPDX-License-Identifier: Apache-2.0
// The command line of this process, for the reports of the run: whoever has them can do it again.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace conform::cli {

/// All arguments with a blank between, but for options that only say where results go (--junit FILE,
/// --bundle,
/// --journal ...): who does it again wants no report written over, and two runs that differ in nothing else
/// are the same run.
[[nodiscard]] std::string shell_line(const std::vector<std::string>& arguments);
[[nodiscard]] std::string shell_line(std::span<char* const> arguments);

}  // namespace conform::cli
