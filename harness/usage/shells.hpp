// SPDX-License-Identifier: Apache-2.0
// Completion in bash, zsh and fish: small scripts that ask the program, and its answers.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "usage/complete.hpp"

namespace conform::usage {

inline constexpr std::array<const char*, 3> shells{"bash", "zsh", "fish"};

/// What `shell` (one of `shells`) reads to complete the command lines of `program`. Where it is installed
/// `completion_path` says, below the folder share of the prefix.
[[nodiscard]] std::string completion_script(std::string_view shell, const std::string& program);
[[nodiscard]] std::string completion_path(std::string_view shell, const std::string& program);

/// The words of a line that is being typed, as a shell takes them apart; the last one is at the cursor and
/// empty behind a blank. Nothing is expanded.
[[nodiscard]] std::vector<std::string> words_of_line(std::string_view line);

/// The answer to `PROGRAM __complete QUESTION...`. The first line is `files`, `folders`, `open` (nothing
/// stands behind any of the words yet) or `words`; the others are the words, with a tabulator and what each
/// is about. The question is `bash READLINE_WORD LINE`, where words are what takes the place of
/// READLINE_WORD; or `words WORD...`, the last one at the cursor.
[[nodiscard]] std::string completion_answer(CLI::App& app, std::span<const std::string> question,
                                            const Values& values);

}  // namespace conform::usage
