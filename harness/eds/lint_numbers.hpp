// SPDX-License-Identifier: Apache-2.0
// Reading a number for the lint: what is odd about it becomes findings.
#pragma once

#include <optional>
#include <string>

#include "eds/lint_rules.hpp"
#include "eds/number.hpp"

namespace conform::eds {

/// The number in `field`; nullopt, with a finding, when it is none. `label` begins the message: "[1018sub1]
/// DataType".
[[nodiscard]] std::optional<Number> read_number(const Field& field, const std::string& label,
                                                Findings& findings);

}  // namespace conform::eds
