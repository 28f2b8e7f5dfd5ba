// SPDX-License-Identifier: Apache-2.0
// A command line as the parser knows it, seen by who completes words and who writes man pages: whatever a
// command gets as an option is in both by itself.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace conform::usage {

/// The sub-commands in the order of the help, without the hidden ones.
[[nodiscard]] std::vector<CLI::App*> commands_of(CLI::App& app);
/// The options with a name, in the order of the help, without the hidden ones.
[[nodiscard]] std::vector<CLI::Option*> options_of(CLI::App& app);
/// The arguments without one, in their order.
[[nodiscard]] std::vector<CLI::Option*> arguments_of(CLI::App& app);

/// "eds lint"; empty for the program itself.
[[nodiscard]] std::string path_of(const CLI::App& app);
/// "--interface", else "-i", else the name of the argument.
[[nodiscard]] std::string name_of(const CLI::Option& option);
/// What stands for the value, "RESULT|JOURNAL"; empty for a flag.
[[nodiscard]] std::string type_of(const CLI::Option& option);
[[nodiscard]] bool is_repeatable(const CLI::Option& option);
/// The words that an option accepts, where these are a closed set (CLI::IsMember); else empty.
[[nodiscard]] std::vector<std::string> closed_set_of(CLI::Option& option);

}  // namespace conform::usage
