// SPDX-License-Identifier: Apache-2.0
// What is told about a command beside its options, once for the help and for the man page.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace conform::usage {

struct Example {
  std::string_view line;  ///< as it is typed, with the program
  std::string_view does;  ///< one line, lower case, no full stop
  int exits = 0;          ///< with this exit code, where what it names is there
};

/// An exit code, a file, a variable of the environment, and what it is.
struct Entry {
  std::string term, meaning;
};

struct CommandPage {
  std::string_view command;  ///< "eds lint"; empty: the program itself
  std::vector<Example> examples;
  std::vector<Entry> exits;
  std::vector<std::string_view> about = {};  ///< paragraphs behind the description
};

struct Manual {
  std::string program;  ///< "canopen-conform"
  std::string summary;  ///< one line, lower case, no full stop: what the program is
  std::vector<CommandPage> pages;
  std::vector<Entry> files = {};           ///< told by the page of the program
  std::vector<std::string> see_also = {};  ///< other programs, "canopen-refnode"
  /// The variables that a command reads.
  std::function<std::vector<Entry>(CLI::App& command)> environment = {};
};

/// The page of a command; nullptr: there is none.
[[nodiscard]] const CommandPage* page_of(const Manual& manual, const CLI::App& command);

/// Puts the examples at the end of the help of each command.
void add_examples(CLI::App& app, const Manual& manual);

/// A line for each example: exit code, tabulator, the line.
[[nodiscard]] std::string example_list(const Manual& manual);

struct ManPage {
  std::string name;  ///< of the file: "canopen-conform-run.1"
  std::string text;  ///< roff with the macros of man(7)
};

/// One for the program and one for each command that is not hidden. `date` (2027-03-31) and `version` stand
/// in the margins.
[[nodiscard]] std::vector<ManPage> man_pages(CLI::App& app, const Manual& manual, std::string_view date,
                                             std::string_view version);

}  // namespace conform::usage
