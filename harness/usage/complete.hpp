// SPDX-License-Identifier: Apache-2.0
// What can stand at the cursor of a command line: sub-commands, options, values.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace conform::usage {

struct Candidate {
  std::string word;
  std::string about;  ///< one line, may be empty
};

/// What a shell offers. Files and folders it knows itself.
struct Completion {
  enum class Kind { words, files, folders };
  Kind kind = Kind::words;
  std::vector<Candidate> words;
};

/// Where a value stands that is to be completed.
struct Place {
  CLI::App* command = nullptr;
  CLI::Option* option = nullptr;  ///< an argument, too
  /// Of the options before it, by `name_of`; flags without values.
  std::map<std::string, std::vector<std::string>> given;
};

/// The values that only the program knows; nullopt: those that the type of the option tells.
using Values = std::function<std::optional<std::vector<Candidate>>(const Place&)>;

/// `before`: the words between the program and the one at the cursor, of which `current` is what stands
/// before the cursor. All candidates begin with `current`. Words with slashes, such as ids of scenarios, are
/// completed folder by folder, the incomplete ones end with the slash.
[[nodiscard]] Completion complete(CLI::App& app, std::span<const std::string> before,
                                  const std::string& current, const Values& values);

}  // namespace conform::usage
