// SPDX-License-Identifier: Apache-2.0
// The table of report formats: the command line, its help and its file names are made from it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reports/beside.hpp"
#include "result/run_result.hpp"

namespace conform::reports {

struct Format {
  std::string_view name;     ///< as on the command line: "junit"
  std::string_view summary;  ///< one line of help
  std::string_view suffix;   ///< of the file: ".xml"
  std::string (*write)(const result::RunResult& run, const Beside& beside);
};

/// All formats in the order of the help text.
[[nodiscard]] std::span<const Format> formats();
/// The format of this name, or nullptr.
[[nodiscard]] const Format* find_format(std::string_view name);
/// Their names, for messages and suggestions.
[[nodiscard]] std::vector<std::string_view> format_names();

}  // namespace conform::reports
