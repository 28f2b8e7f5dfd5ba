// SPDX-License-Identifier: Apache-2.0
// The elementary types of CiA 311 and which objects a parameter of it can describe.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "eds/eds.hpp"

namespace conform::eds {

struct XddType {
  std::string_view element;  ///< "USINT"
  std::uint16_t data_type;   ///< the CANopen type that carries it
};
/// The first row of a data type is the one to write.
[[nodiscard]] std::span<const XddType> xdd_types();
/// Empty when no elementary type has this data type.
[[nodiscard]] std::string_view xdd_type_of(std::uint16_t data_type);

/// A parameter has an elementary type, and either both limits or none.
[[nodiscard]] bool parameter_can_say(const Entry& entry);

enum class ObjectList : std::uint8_t { mandatory, optional, manufacturer };
/// By CiA 306: 1000h, 1001h and 1018h are mandatory, 2000h to 5FFFh the manufacturer's.
[[nodiscard]] ObjectList list_of(Index index);

}  // namespace conform::eds
