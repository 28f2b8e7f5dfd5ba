// SPDX-License-Identifier: Apache-2.0
// COB-ID entries, the pre-defined connection set (CiA 301, 7.3.3) and the restricted CAN-IDs (7.3.5, table
// 40).
//
// Bits of the entries:       31                  30                 29      28..0
//   1005h SYNC               reserved            1: generates SYNC  frame   CAN-ID
//   1012h TIME               1: consumes TIME    1: produces TIME   frame   CAN-ID
//   1014h EMCY               0: valid            reserved           frame   CAN-ID
//   1028h:nn EMCY consumer   0: valid            reserved           frame   CAN-ID
//   12xxh:01/02 SDO          0: valid            1: dynamic         frame   CAN-ID
//   14xxh:01 RPDO            0: valid            reserved           frame   CAN-ID
//   18xxh:01 TPDO            0: valid            0: RTR allowed     frame   CAN-ID
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "base/strong.hpp"

namespace conform::canopen {

namespace cob_id {
inline constexpr std::uint32_t bit31 = 0x8000'0000U;
inline constexpr std::uint32_t bit30 = 0x4000'0000U;
inline constexpr std::uint32_t extended_frame = 0x2000'0000U;
inline constexpr std::uint32_t can_id_mask = 0x1FFF'FFFFU;
inline constexpr std::uint32_t base_id_mask = 0x0000'07FFU;
}  // namespace cob_id

enum class CobIdKind : std::uint8_t { sync, time, emcy, emcy_consumer, sdo, rpdo, tpdo };

/// What the object at `mux` is when it holds a COB-ID; nullopt for all other entries.
[[nodiscard]] std::optional<CobIdKind> cob_id_kind(Multiplexer mux);

/// The CAN-ID part: 11 bits, or 29 when bit 29 is set.
[[nodiscard]] CanId can_id_of(CobId value);
[[nodiscard]] bool is_extended(CobId value);
/// The bits that lock bits 0-29: bit 31 for most, bit 30 for SYNC, both for TIME.
[[nodiscard]] std::uint32_t control_mask(CobIdKind kind);
/// Whether the service works with this value, so that its CAN-ID must not change: bit 31 = 0 for most, bit 30
/// = 1 for SYNC, bit 30 or 31 = 1 for TIME.
[[nodiscard]] bool is_active(CobIdKind kind, CobId value);
/// `value` with the service switched off, everything else kept: the first of the three writes that change a
/// COB-ID.
[[nodiscard]] CobId deactivated(CobIdKind kind, CobId value);
/// The writes that change a COB-ID: off, change, on. Bits 0-29 are locked while the service is active.
[[nodiscard]] std::array<CobId, 3> change_sequence(CobIdKind kind, CobId from, CobId to);

/// CAN-IDs of the pre-defined connection set for one node.
struct ConnectionSet {
  CanId emcy, sdo_request, sdo_response, error_control;
  CanId tpdo[4];
  CanId rpdo[4];
};
[[nodiscard]] ConnectionSet connection_set(NodeId node);
inline constexpr CanId nmt_can_id{0x000};
inline constexpr CanId sync_can_id{0x080};
inline constexpr CanId time_can_id{0x100};
inline constexpr CanId lss_request_can_id{0x7E5};
inline constexpr CanId lss_response_can_id{0x7E4};

struct CanIdRange {
  std::uint32_t first, last;
  std::string_view use;  ///< what the range is reserved for
};
/// 11-bit CAN-IDs that no configurable object may use, ascending.
[[nodiscard]] std::span<const CanIdRange> restricted_ranges();
/// Only 11-bit CAN-IDs are restricted; anything above 7FFh is not.
[[nodiscard]] bool is_restricted(CanId id);

}  // namespace conform::canopen
