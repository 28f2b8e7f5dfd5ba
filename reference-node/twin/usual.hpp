// SPDX-License-Identifier: Apache-2.0
// What the standard says of communication objects where a device description is silent.
#pragma once

#include <cstdint>
#include <optional>

namespace refnode {

/// The power-on value of an entry without a default: the pre-defined connection set (CiA 301, 7.3.5), "not
/// valid" for what has no place in it, and what a service needs to be one. nullopt for all other entries.
[[nodiscard]] std::optional<std::uint64_t> usual_value(std::uint16_t index, std::uint8_t sub,
                                                       std::uint8_t node_id);
/// Whether the entry is the COB-ID of a service that this node has.
[[nodiscard]] bool is_served_cob_id(std::uint16_t index, std::uint8_t sub);
/// 16xxh, 17xxh, 1Axxh, 1Bxxh.
[[nodiscard]] bool is_pdo_mapping(std::uint16_t index);
[[nodiscard]] bool is_pdo_communication(std::uint16_t index);
/// Whether sub-index 00h holds the highest sub-index; otherwise something else is counted there.
[[nodiscard]] bool sub_zero_is_highest(std::uint16_t index);

}  // namespace refnode
