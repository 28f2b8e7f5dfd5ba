// SPDX-License-Identifier: Apache-2.0
// Defects of COB-ID parameters, whatever they are of: another answer to one of their rules.
#pragma once

#include <cstdint>

#include "defects/hooks.hpp"

namespace refnode::defect {

// Of a COB-ID: what its upper bits say, and the CAN-ID of a frame with 11 bits.
inline constexpr std::uint32_t bit_31 = 0x8000'0000;
inline constexpr std::uint32_t bit_30 = 0x4000'0000;
inline constexpr std::uint32_t can_id_bits = 0x7FF;

inline CobIdRules& of_sync(Parts& parts) { return parts.sync.cob_id_rules; }
inline CobIdRules& of_time(Parts& parts) { return parts.time.cob_id_rules; }
inline CobIdRules& of_emergency(Parts& parts) { return parts.emergency.cob_id_rules; }
inline CobIdRules& of_emergencies(Parts& parts) { return parts.emergencies.cob_id_rules; }
inline CobIdRules& of_rpdo(Parts& parts) { return parts.pdos.rpdo.parameters.cob_id_rules; }
inline CobIdRules& of_tpdo(Parts& parts) { return parts.pdos.tpdo.parameters.cob_id_rules; }
inline CobIdRules& of_sdo_server(Parts& parts) { return parts.sdo.cob_id_rules; }
inline CobIdRules& of_sdo_client(Parts& parts) { return parts.sdo.client_cob_id_rules; }

using CobIdPart = CobIdRules& (*)(Parts&);

/// The rule always answers the same.
[[nodiscard]] inline Change decided(CobIdPart part, CobIdRules::Predicate CobIdRules::* rule, bool answer) {
  return decides(part, rule, [answer](const auto&, std::uint32_t) { return answer; });
}
[[nodiscard]] inline Change inverted(CobIdPart part, CobIdRules::Predicate CobIdRules::* rule) {
  return decides(part, rule, [](const auto& former, std::uint32_t value) { return !former(value); });
}
[[nodiscard]] inline Change stays_on_default(CobIdPart part) {
  return decides(part, &CobIdRules::can_id, [](const auto& former, std::uint32_t, std::uint32_t at_power_on) {
    return former(at_power_on, at_power_on);
  });
}
/// Another CAN-ID, whatever becomes of bits 31 and 30.
inline bool is_moved(std::uint64_t present, std::uint64_t wanted) {
  return ((present ^ wanted) & 0x3FFFFFFFU) != 0;
}

/// No entry of the object takes another CAN-ID.
[[nodiscard]] inline Change keeps_can_ids(std::uint16_t index) {
  return checking_all(index, [index](Parts& parts, const Check& former, std::uint8_t sub, ByteView bytes) {
    const bool moved = is_moved(parts.device.dictionary.number(index, sub), conform::load_le(bytes));
    return moved ? refuse(abort_code::invalid_value) : former(bytes);
  });
}

}  // namespace refnode::defect
