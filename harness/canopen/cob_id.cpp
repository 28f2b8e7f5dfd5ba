// SPDX-License-Identifier: Apache-2.0
#include "canopen/cob_id.hpp"

#include <algorithm>
#include <array>

#include "base/check.hpp"

namespace conform::canopen {
namespace {

constexpr std::array<CanIdRange, 8> ranges{{
    {0x000, 0x000, "NMT"},
    {0x001, 0x07F, "reserved"},
    {0x101, 0x180, "reserved"},
    {0x581, 0x5FF, "default SDO, server to client"},
    {0x601, 0x67F, "default SDO, client to server"},
    {0x6E0, 0x6FF, "reserved"},
    {0x701, 0x77F, "NMT error control"},
    {0x780, 0x7FF, "reserved"},
}};

constexpr bool within(std::uint16_t index, std::uint16_t first, std::uint16_t last) {
  return index >= first && index <= last;
}

}  // namespace

std::optional<CobIdKind> cob_id_kind(Multiplexer mux) {
  const std::uint16_t index = mux.index.value();
  const std::uint8_t sub = mux.sub.value();
  if (sub == 0) {
    if (index == 0x1005) return CobIdKind::sync;
    if (index == 0x1012) return CobIdKind::time;
    if (index == 0x1014) return CobIdKind::emcy;
    return std::nullopt;
  }
  if (index == 0x1028 && sub <= 127) return CobIdKind::emcy_consumer;
  if (within(index, 0x1200, 0x12FF) && sub <= 2) return CobIdKind::sdo;
  if (within(index, 0x1400, 0x15FF) && sub == 1) return CobIdKind::rpdo;
  if (within(index, 0x1800, 0x19FF) && sub == 1) return CobIdKind::tpdo;
  return std::nullopt;
}

CanId can_id_of(CobId value) {
  return CanId{value.value() & (is_extended(value) ? cob_id::can_id_mask : cob_id::base_id_mask)};
}

bool is_extended(CobId value) { return (value.value() & cob_id::extended_frame) != 0; }

std::uint32_t control_mask(CobIdKind kind) {
  if (kind == CobIdKind::sync) return cob_id::bit30;
  if (kind == CobIdKind::time) return cob_id::bit31 | cob_id::bit30;
  return cob_id::bit31;
}

bool is_active(CobIdKind kind, CobId value) {
  const std::uint32_t control = value.value() & control_mask(kind);
  return kind == CobIdKind::sync || kind == CobIdKind::time ? control != 0 : control == 0;
}

CobId deactivated(CobIdKind kind, CobId value) {
  const std::uint32_t mask = control_mask(kind);
  if (kind == CobIdKind::sync || kind == CobIdKind::time) return CobId{value.value() & ~mask};
  return CobId{value.value() | mask};
}

std::array<CobId, 3> change_sequence(CobIdKind kind, CobId from, CobId to) {
  return {deactivated(kind, from), deactivated(kind, to), to};
}

ConnectionSet connection_set(NodeId node) {
  const std::uint32_t n = node.value();
  CONFORM_CHECK(n >= 1 && n <= 127);
  return {.emcy = CanId{0x080 + n},
          .sdo_request = CanId{0x600 + n},
          .sdo_response = CanId{0x580 + n},
          .error_control = CanId{0x700 + n},
          .tpdo = {CanId{0x180 + n}, CanId{0x280 + n}, CanId{0x380 + n}, CanId{0x480 + n}},
          .rpdo = {CanId{0x200 + n}, CanId{0x300 + n}, CanId{0x400 + n}, CanId{0x500 + n}}};
}

std::span<const CanIdRange> restricted_ranges() { return ranges; }

bool is_restricted(CanId id) {
  return std::ranges::any_of(
      ranges, [&](const CanIdRange& range) { return id.value() >= range.first && id.value() <= range.last; });
}

}  // namespace conform::canopen
