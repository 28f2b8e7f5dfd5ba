// SPDX-License-Identifier: Apache-2.0
// Options that several sub-commands have.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/commands/commands.hpp"

namespace conform::cli {

void add_waivers(CLI::App& app, std::vector<std::string>& into);
/// An option for each format of reports.
void add_reports(CLI::App& app, Reports& into);
void add_bundle(CLI::App& app, std::string& file, std::string& key);

}  // namespace conform::cli
