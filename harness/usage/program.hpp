// SPDX-License-Identifier: Apache-2.0
// What a program is asked by the scripts of shells, by the build and by tests, never by people: commands that
// begin with two underlines and stand in no help.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "base/error.hpp"
#include "usage/complete.hpp"
#include "usage/manual.hpp"

namespace conform::usage {

/// What it prints for
///   __complete QUESTION...   the answer to a shell (shells.hpp)
///   __share FOLDER DATE      nothing: writes man pages and completions below FOLDER, as they stand in share/
///   __examples               all examples of the help with their exit codes
///   __parse WORD...          nothing: an error tells what is wrong with this command line, which is not run
/// `arguments` without the program. nullopt: it is asked for none of them.
[[nodiscard]] std::optional<Result<std::string>> answer_hidden(CLI::App& app,
                                                               std::span<const std::string> arguments,
                                                               const Manual& manual, const Values& values,
                                                               const std::string& version);

}  // namespace conform::usage
