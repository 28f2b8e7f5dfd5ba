// SPDX-License-Identifier: Apache-2.0
#include "engine/walk_values.hpp"

#include <algorithm>

#include "canopen/cob_id.hpp"
#include "catch.hpp"

using namespace conform;
using namespace conform::engine;

TEST_CASE("of the restricted CAN-IDs a walk takes a sample, and with all objects every one") {
  const auto all = restricted_can_ids(NodeId(5), true);
  CHECK(all.size() == 797);
  const auto some = restricted_can_ids(NodeId(5), false);
  CHECK(some.size() < all.size() / 4);
  CHECK(std::ranges::is_sorted(some));
  CHECK(std::ranges::includes(all, some));
  const auto has = [&](std::uint32_t id) { return std::ranges::binary_search(some, id); };
  for (const auto& range : canopen::restricted_ranges()) {
    CHECK(has(range.first));
    CHECK(has(range.last));
  }
  // The node's own services, whatever its node-ID.
  const auto set = canopen::connection_set(NodeId(5));
  CHECK(has(set.sdo_request.value()));
  CHECK(has(set.sdo_response.value()));
  CHECK(has(set.error_control.value()));
}

TEST_CASE(
    "in every range that is long enough each of the lower bits is once set and once clear in the sample") {
  const auto some = restricted_can_ids(NodeId(1), false);
  for (const auto& range : canopen::restricted_ranges()) {
    if (range.last - range.first < 0x7E) continue;
    for (std::uint32_t bit = 1; bit < 0x80; bit <<= 1U) {
      const auto here = [&](std::uint32_t id) { return id >= range.first && id <= range.last; };
      CHECK(std::ranges::any_of(some, [&](auto id) { return here(id) && (id & bit) != 0; }));
      CHECK(std::ranges::any_of(some, [&](auto id) { return here(id) && (id & bit) == 0; }));
    }
  }
}
