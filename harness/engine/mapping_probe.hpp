// SPDX-License-Identifier: Apache-2.0
// Finds out whether the mapping of a PDO can be changed, where nobody says so.
#pragma once

#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/strong.hpp"
#include "steps/session.hpp"

namespace conform::engine {

/// Writes the mapping that a PDO has once more, by the procedure of 7.5.2.36: PDO off, number of entries 0,
/// entries, number, PDO on. nullopt: every write was confirmed. Otherwise why the mapping cannot be changed,
/// or why it could not be tried. Error: no answer, or the environment failed.
[[nodiscard]] Result<std::optional<std::string>> why_mapping_is_fixed(steps::Session& session,
                                                                      Index communication);

}  // namespace conform::engine
