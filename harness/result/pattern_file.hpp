// SPDX-License-Identifier: Apache-2.0
// The patterns of known mistakes as a file: suites/patterns/reference-node.json, made by
// `canopen-conform selftest --patterns FILE`.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "result/patterns.hpp"

namespace conform::result {

/// A line for each pattern, so that a change of one is a change of one line.
[[nodiscard]] std::string pattern_file(std::span<const Pattern> patterns);

/// Error: no such file, with the place of the mistake; `where` is its name.
[[nodiscard]] Result<std::vector<Pattern>> read_patterns(std::string_view text, const std::string& where);

}  // namespace conform::result
