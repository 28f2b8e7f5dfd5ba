// SPDX-License-Identifier: Apache-2.0
#include "engine/walk_values.hpp"

#include "canopen/cob_id.hpp"

namespace conform::engine {

std::vector<std::uint32_t> restricted_can_ids(NodeId node, bool all) {
  std::vector<std::uint32_t> out;
  for (const auto& range : canopen::restricted_ranges()) {
    for (auto id = range.first; id <= range.last; ++id) {
      const bool at_an_end = id < range.first + 2 || id + 2 > range.last;
      // Function code and node-ID (table 39).
      const bool own = id % 0x80 == node.value();
      if (all || at_an_end || own || id % 7 == 0) out.push_back(id);
    }
  }
  return out;
}

}  // namespace conform::engine
