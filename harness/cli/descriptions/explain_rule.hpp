// SPDX-License-Identifier: Apache-2.0
// What a rule of the lint is about, for people.
#pragma once

#include <string>

#include "eds/lint.hpp"

namespace conform::cli {

/// The mistake, its source, an example of wrong and right if there is one, and how the rule is allowed.
[[nodiscard]] std::string explain_rule(const eds::Rule& rule);

}  // namespace conform::cli
