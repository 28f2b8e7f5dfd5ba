// SPDX-License-Identifier: Apache-2.0
// One finding in full, for somebody who knows the device and the standard and has never seen this tool.
#pragma once

#include <string>

#include "reports/html/book.hpp"
#include "reports/phrases.hpp"

namespace conform::reports::html {

/// The rule, expected against actual, the frames, the place in the scenario and the command that repeats it.
/// Markup without a heading.
[[nodiscard]] std::string card(const Book& book, const LocatedFinding& located);

/// The command that repeats one case, or for a monitor what was going on: "canopen-conform run --simulate
/// ...".
[[nodiscard]] std::string repeat_command(const result::RunResult& run, const result::CaseResult& one,
                                         const std::string& during, const std::string& requirement);

}  // namespace conform::reports::html
