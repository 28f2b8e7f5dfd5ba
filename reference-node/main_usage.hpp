// SPDX-License-Identifier: Apache-2.0
// What help, man page and completion of canopen-refnode tell beside its options.
#pragma once

#include <optional>
#include <vector>

#include "usage/complete.hpp"
#include "usage/manual.hpp"

namespace refnode {

[[nodiscard]] conform::usage::Manual manual();

/// The ids of defects and variants, and the CAN interfaces of this machine.
[[nodiscard]] std::optional<std::vector<conform::usage::Candidate>> known_values(
    const conform::usage::Place& place);

}  // namespace refnode
