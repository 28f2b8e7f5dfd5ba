// SPDX-License-Identifier: Apache-2.0
// The options of `explore` on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/commands/explore_command.hpp"

namespace conform::cli {

/// The sub-command, whose options go into `command`; both live as long as the parser.
CLI::App* add_explore(CLI::App& app, ExploreCommand& command);

}  // namespace conform::cli
