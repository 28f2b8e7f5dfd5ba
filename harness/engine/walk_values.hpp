// SPDX-License-Identifier: Apache-2.0
// The named sets of values that `over` walks over.
#pragma once

#include <cstdint>
#include <vector>

#include "base/strong.hpp"

namespace conform::engine {

/// CAN-IDs of CiA 301, 7.3.5, ascending: all of them, or a sample that is the same in every run. It has both
/// ends of each range and their neighbours, those of the node's own services, and every seventh in between,
/// so that every bit of those that are left varies.
[[nodiscard]] std::vector<std::uint32_t> restricted_can_ids(NodeId node, bool all);

}  // namespace conform::engine
