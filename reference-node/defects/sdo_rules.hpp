// SPDX-License-Identifier: Apache-2.0
// Where defects of the SDO server take hold: its rules, and whose request a frame is.
#pragma once

#include <cstdint>
#include <optional>

#include "defects/hooks.hpp"

namespace refnode::defect {

inline SdoRules& of_sdo(Parts& parts) { return parts.sdo.rules; }
inline SegmentedRules& of_segments(Parts& parts) { return parts.sdo.rules.segmented; }

/// An abort by this side does not end the transfer.
[[nodiscard]] inline Change goes_on_after_abort(SdoSide side) {
  return decides(of_sdo, &SdoRules::abort_ends_transfer, [side](const auto& former, SdoSide by, bool block) {
    return by != side && former(by, block);
  });
}
/// While a transfer is open no new one is served.
[[nodiscard]] inline Change begins_nothing_while_busy() {
  return decides(of_sdo, &SdoRules::may_begin, [](const auto& former, bool transfer_open) {
    return !transfer_open && former(transfer_open);
  });
}
/// Transfers stay open when the node enters `state`.
[[nodiscard]] inline Change keeps_transfers_in(NmtState state) {
  return decides(of_sdo, &SdoRules::transfers_end_in, [state](const auto& former, NmtState entered) {
    return entered != state && former(entered);
  });
}

/// A data frame with an identifier of 11 bits.
inline bool is_base_data_frame(const Frame& frame) { return !frame.extended && !frame.remote; }

/// The CAN-ID on which the server of `channel` answers.
inline std::uint32_t response_id(Parts& parts, std::uint8_t channel) {
  if (channel == 0) return 0x580U + parts.device.node_id;
  const auto index = static_cast<std::uint16_t>(first_sdo_server + channel);
  return static_cast<std::uint32_t>(parts.device.dictionary.number(index, 2)) & 0x7FFU;
}
/// Number of the server that takes requests on this CAN-ID.
inline std::optional<std::uint8_t> channel_of(Parts& parts, std::uint32_t id) {
  constexpr std::uint64_t not_valid = 0x80000000;
  if (id == 0x600U + parts.device.node_id) return 0;
  for (std::uint16_t index = first_sdo_server + 1; index <= last_sdo_server; ++index) {
    const std::uint64_t received_on = parts.device.dictionary.number(index, 1, not_valid);
    const std::uint64_t sent_on = parts.device.dictionary.number(index, 2, not_valid);
    if (((received_on | sent_on) & not_valid) == 0 && (received_on & 0x7FFU) == id)
      return static_cast<std::uint8_t>(index - first_sdo_server);
  }
  return std::nullopt;
}

}  // namespace refnode::defect
