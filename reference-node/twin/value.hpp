// SPDX-License-Identifier: Apache-2.0
// What the text of a device description means as a value of a data type (CiA 306). The harness reads the same
// texts with code of its own: were it shared, a value misread here would be expected there.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/bytes.hpp"
#include "dictionary/object_dictionary.hpp"

namespace refnode {

/// A value of an integer type, BOOLEAN included; UNSIGNED64 as the same 64 bits. Decimal, 0x hexadecimal,
/// octal after a leading 0, $NODEID and what is added to it. A hexadecimal or octal number may be the two's
/// complement of a negative one. nullopt for anything else and for what the type cannot hold.
[[nodiscard]] std::optional<std::int64_t> read_integer(std::string_view text, DataType type,
                                                       std::uint8_t node_id);

/// A value of REAL32 or REAL64: a decimal number, or 0x and the bits of the number.
[[nodiscard]] std::optional<double> read_real(std::string_view text, DataType type);

/// Bytes in transmission order. nullopt: the text is no value of the type. What is written for an
/// OCTET_STRING or DOMAIN and is not made of pairs of digits has no agreed meaning and is no value either.
[[nodiscard]] std::optional<Bytes> read_value(std::string_view text, DataType type, std::uint8_t node_id);

}  // namespace refnode
