// SPDX-License-Identifier: Apache-2.0
// Whether two texts mean the same: 0x10 and 16, 0x80+$NODEID and $NODEID+128, 1.0 and 1, no and 0.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "eds/eds.hpp"

namespace conform::eds {

/// Values of a data type of CiA 301 (nullopt: not known). Numbers are the same whatever their form, an
/// integer and its two's complement, too; REAL by value, whether decimal or as a pattern of bits; strings
/// byte by byte; octets without blanks. What is no value of its type is compared as text.
[[nodiscard]] bool same_value(std::string_view a, std::string_view b, std::optional<std::uint16_t> data_type);

/// Numbers that have no data type, such as a ProductNumber. What is no number is compared as text.
[[nodiscard]] bool same_number(std::string_view a, std::string_view b);

/// Values of entries as same_value() compares them, but a formula and a number may be one value: `node` is
/// the node-ID of the formula; without it they are one when some node-ID makes it so.
[[nodiscard]] bool may_be_same_value(const Field& a, const Field& b, std::optional<std::uint16_t> data_type,
                                     std::optional<std::uint8_t> node);

/// The node-ID of a configuration; nothing in a description.
[[nodiscard]] std::optional<std::uint8_t> configured_node(const EdsFile& file);

/// 0 and 1 as EDS and XDD write them: number, false or true, no or yes; nothing at all is 0.
[[nodiscard]] bool same_flag(std::string_view a, std::string_view b);

}  // namespace conform::eds
