// SPDX-License-Identifier: Apache-2.0
// Whether two texts of a description mean one value: 0x01 and 1, 0x581 and $NODEID+0x580 of node 1, 1.50 and
// 1.5, true and 1.
#pragma once

#include <cstdint>
#include <optional>

#include "eds/eds.hpp"

namespace conform::eds {

/// Compares by the data type (its index; nothing: as numbers, where both are). `node`: the node-ID of a
/// formula; without it a formula equals a number when some node-ID makes it so. What is no value of the type
/// is compared as text.
[[nodiscard]] bool same_value(const Field& a, const Field& b, std::optional<std::uint16_t> type,
                              std::optional<std::uint8_t> node);

/// The node-ID of a configuration; nothing in a description.
[[nodiscard]] std::optional<std::uint8_t> configured_node(const EdsFile& file);

}  // namespace conform::eds
