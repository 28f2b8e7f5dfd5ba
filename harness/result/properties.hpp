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

/// The same as text; empty where there is none.
[[nodiscard]] inline std::string property_of(const RunResult& run, std::string_view name) {
  const auto* value = value_of(run, name);
  return value == nullptr ? std::string() : *value;
}

}  // namespace conform::result
