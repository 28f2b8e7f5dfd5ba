// SPDX-License-Identifier: Apache-2.0
// The values of options that shells cannot know: ids of scenarios, requirements, monitors, defects, variants
// and rules, and the CAN interfaces of this machine.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "usage/complete.hpp"

namespace conform::cli {

/// nullopt: what the type of the option tells, such as a file, is all there is.
[[nodiscard]] std::optional<std::vector<usage::Candidate>> known_values(const usage::Place& place);

/// The ids in a file of scenarios or requirements, with `prefix` before each, and their titles where these
/// stand on one line. By its lines, not as YAML: a key press has no time for a thousand requirements, and who
/// reads candidates needs no verdict about a file.
[[nodiscard]] std::vector<usage::Candidate> ids_in(std::string_view text, const std::string& prefix);

}  // namespace conform::cli
