// SPDX-License-Identifier: Apache-2.0
// A command of the user, run by the shell.
#pragma once

#include <string>

#include "base/error.hpp"
#include "base/time.hpp"

namespace conform::cli {

/// Waits until the command has ended, for `limit` at most; then it is killed with everything it started. An
/// error where it fails. What it prints goes to standard error.
[[nodiscard]] Result<void> run_shell(const std::string& command, Duration limit);

}  // namespace conform::cli
