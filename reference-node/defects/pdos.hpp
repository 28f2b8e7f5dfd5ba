// SPDX-License-Identifier: Apache-2.0
// Defects that PDOs of both directions can have: of their parameters, other than COB-IDs, and of the values
// they carry.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "defects/hooks.hpp"

namespace refnode::defect {

using PdoRulesPart = PdoRules& (*)(Parts&);

// Numbers of PDOs: 0 is 1400h or 1800h.
inline constexpr std::uint16_t second_pdo = 1;
inline constexpr std::uint16_t third_pdo = 2;
inline constexpr std::uint16_t last_pdo = 3;

/// Index of the object of this number in a row of objects.
constexpr std::uint16_t nth(std::uint16_t first, std::uint16_t number) {
  return static_cast<std::uint16_t>(first + number);
}
/// What was written to this sub-index of some objects in a row, by their number; a reset is none of its
/// business.
[[nodiscard]] std::shared_ptr<std::map<std::uint16_t, std::uint64_t>> written_ever(
    Parts& parts, std::uint16_t first, std::uint8_t sub, std::uint16_t count = last_pdo + 1);
/// Index of the communication parameters of an RPDO.
constexpr std::uint16_t rpdo_communication(std::uint16_t number) { return nth(0x1400, number); }
/// The number of the valid RPDO that has this CAN-ID of 11 bits.
[[nodiscard]] std::optional<std::uint16_t> rpdo_with(const ObjectDictionary& od, std::uint32_t can_id);

/// Sub-index 00h of a mapping may hold more (FEh, FFh), which is no number of objects.
inline constexpr std::uint8_t most_mapped = 0x40;
/// The bits of the first `count` entries of a mapping (16xxh, 1Axxh) as it is held, too long or not.
[[nodiscard]] std::size_t bits_held(const ObjectDictionary& od, std::uint16_t mapping, std::uint64_t count);

/// Another decision for one PDO of a direction; for the others the rule stays as it is.
template <typename Rules, typename Answer, typename... Given, typename Other>
[[nodiscard]] Change decides_for(std::uint16_t number, Rules& (*part)(Parts&),
                                 Rule<Answer(const PdoParameters&, Given...)> Rules::* rule, Other other) {
  return decides(part, rule,
                 [number, other](const auto& former, const PdoParameters& pdo, Given... given) -> Answer {
                   if (pdo.number() != number) return former(pdo, given...);
                   return other(former, pdo, given...);
                 });
}

/// A decision that remembers something: `other(memory, former, given...)`, one memory for each node.
template <typename Memory, typename Rules, typename Answer, typename... Given, typename Other>
[[nodiscard]] Change decides_by(Rules& (*part)(Parts&), Rule<Answer(Given...)> Rules::* rule, Other other) {
  return [part, rule, other](Parts& parts) {
    (part(parts).*rule)
        .replace([memory = std::make_shared<Memory>(), other](const auto& former, Given... given) -> Answer {
          return other(*memory, former, given...);
        });
  };
}

inline PdoRules& rpdo_parameters(Parts& parts) { return parts.pdos.rpdo.parameters.rules; }
inline PdoRules& tpdo_parameters(Parts& parts) { return parts.pdos.tpdo.parameters.rules; }

inline ReceivePdoRules& rpdo_traffic(Parts& parts) { return parts.pdos.rpdo.rules; }
inline TransmitPdoRules& tpdo_traffic(Parts& parts) { return parts.pdos.tpdo.rules; }

/// This part of the parameters can be changed at any time, of every PDO or of one.
[[nodiscard]] Change unlocked(PdoRulesPart of, PdoPart part);
[[nodiscard]] Change unlocked(PdoRulesPart of, PdoPart part, std::uint16_t number);

[[nodiscard]] Change maps_absent_objects(PdoRulesPart of);
/// Whatever length a mapping entry gives, it is taken for the right one.
[[nodiscard]] Change maps_any_length(PdoRulesPart of);

enum class CountThat : std::uint8_t { exceeds_the_entries, exceeds_64_bits };

/// Sub-index 00h of the mapping parameter takes a count although it is too large in this way.
[[nodiscard]] Change takes_count(std::uint16_t index, CountThat too_large);

/// Puts another value, of the same length, in place of that of a mapped object.
using ValueChange = void (*)(const Entry& mapped, Bytes& value);

/// RPDOs bring other values than were sent, TPDOs send others than there are.
[[nodiscard]] Change receives_values(ValueChange as);
[[nodiscard]] Change sends_values(ValueChange as);

/// The most significant byte first.
void reversed(const Entry& mapped, Bytes& value);

}  // namespace refnode::defect
