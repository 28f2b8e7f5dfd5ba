// SPDX-License-Identifier: Apache-2.0
// Switches the rows of defects/ and variants/ on, by their ids.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "parts/parts.hpp"

namespace refnode {

/// Fails with a hint on unknown variants and on those that exclude each other.
[[nodiscard]] conform::Result<void> apply_variants(const std::vector<std::string>& ids, Parts& parts);
/// Fails with a hint on unknown and repeated defects.
[[nodiscard]] conform::Result<void> apply_defects(const std::vector<std::string>& ids, Parts& parts);

}  // namespace refnode
