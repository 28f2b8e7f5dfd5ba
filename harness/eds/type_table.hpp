// SPDX-License-Identifier: Apache-2.0
// The data types of CiA 301, 7.4.7, as far as a description can be checked by them.
#pragma once

#include <cstdint>
#include <string_view>

namespace conform::eds {

enum class TypeKind : std::uint8_t {
  boolean,
  signed_integer,
  unsigned_integer,
  real,
  text,
  octets,
  domain,
  time,
  record
};

struct TypeInfo {
  std::uint16_t code;
  std::string_view name;
  unsigned bits;  ///< 0: no fixed length
  TypeKind kind;
};

/// nullptr for a type that CiA 301 does not define (reserved, manufacturer-specific or of a profile).
[[nodiscard]] const TypeInfo* find_type(std::uint16_t code);
/// Neither defined nor in a range where manufacturers and profiles define theirs.
[[nodiscard]] bool is_reserved_type(std::uint16_t code);

}  // namespace conform::eds
