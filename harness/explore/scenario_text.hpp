// SPDX-License-Identifier: Apache-2.0
// A finding as a scenario that a run plays: the conversation, and at its end what the standard asks for.
#pragma once

#include <span>
#include <string>

#include "explore/explorer.hpp"

namespace conform::explore {

/// Whether there is a rule, and a step that can ask for it.
[[nodiscard]] bool becomes_scenario(const Finding& finding, const Vocabulary& words);

/// A file of scenarios, one for each finding, "finding-1" on. What does not become one stands there as a
/// comment. `remarks`: why each is a comment, too, where it is not empty.
[[nodiscard]] std::string scenario_file(std::span<const Finding> findings, const Vocabulary& words,
                                        std::string_view how, std::span<const std::string> remarks = {});

/// What the device did and what was due, in one line each.
[[nodiscard]] std::string came_text(const Finding& finding, const Vocabulary& words);
[[nodiscard]] std::string due_text(const Finding& finding, const Vocabulary& words);

}  // namespace conform::explore
