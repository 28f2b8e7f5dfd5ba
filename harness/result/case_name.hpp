// SPDX-License-Identifier: Apache-2.0
// Names of cases: "cia301/sdo/upload/known[1008h:00]" is an instance of the scenario in front of the bracket.
#pragma once

#include <string_view>

namespace conform::result {

/// The id of the scenario; of a name or a pattern without an instance all of it.
[[nodiscard]] constexpr std::string_view scenario_of(std::string_view case_name) {
  return case_name.substr(0, case_name.find('['));
}
/// The instance with its brackets; empty: none is named.
[[nodiscard]] constexpr std::string_view instance_of(std::string_view case_name) {
  return case_name.substr(scenario_of(case_name).size());
}

}  // namespace conform::result
