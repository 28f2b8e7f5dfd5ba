// SPDX-License-Identifier: Apache-2.0
// What a run tells of itself by name.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "result/run_result.hpp"

namespace conform::result {

/// The value of the first property of this name; nullptr: there is none.
[[nodiscard]] inline const std::string* value_of(const RunResult& run, std::string_view name) {
  const auto found = std::ranges::find(run.properties, name, &Property::name);
  return found == run.properties.end() ? nullptr : &found->value;
}

}  // namespace conform::result
