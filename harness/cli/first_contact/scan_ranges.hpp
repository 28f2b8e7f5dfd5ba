// SPDX-License-Identifier: Apache-2.0
// Which part of the dictionary is looked at.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "engine/scan.hpp"

namespace conform::cli {

/// "2000h..2FFFh"; none: all that devices use. Error: a text that is no range of indices.
[[nodiscard]] Result<std::vector<engine::IndexRange>> scan_ranges(const std::vector<std::string>& texts);

}  // namespace conform::cli
