// SPDX-License-Identifier: Apache-2.0
// Defects that PDOs of both directions can have: of their parameters, other than COB-IDs, and of the values
// they carry.
#pragma once

#include <cstdint>

#include "defects/hooks.hpp"

namespace refnode::defect {

using PdoRulesPart = PdoRules& (*)(Parts&);

inline PdoRules& rpdo_parameters(Parts& parts) { return parts.pdos.rpdo.parameters.rules; }
inline PdoRules& tpdo_parameters(Parts& parts) { return parts.pdos.tpdo.parameters.rules; }

/// This part of the parameters can be changed at any time.
[[nodiscard]] Change unlocked(PdoRulesPart of, PdoPart part);

[[nodiscard]] Change maps_absent_objects(PdoRulesPart of);
/// Whatever length a mapping entry gives, it is taken for the right one.
[[nodiscard]] Change maps_any_length(PdoRulesPart of);

enum class CountThat : std::uint8_t { exceeds_the_entries, exceeds_64_bits };

/// Sub-index 00h of the mapping parameter takes a count although it is too large in this way.
[[nodiscard]] Change takes_count(std::uint16_t index, CountThat too_large);

/// Puts another value, of the same length, in place of that of a mapped object.
using ValueChange = void (*)(const Entry& mapped, Bytes& value);

/// The first RPDO brings other values than were sent, the first TPDO sends others than there are.
[[nodiscard]] Change receives_values(ValueChange as);
[[nodiscard]] Change sends_values(ValueChange as);

/// The most significant byte first.
void reversed(const Entry& mapped, Bytes& value);

}  // namespace refnode::defect
