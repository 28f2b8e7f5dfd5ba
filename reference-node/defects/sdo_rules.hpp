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
  return decides(of_sdo, &SdoRules::transfers_end_in,
                 [state](const auto& former, NmtState entered, std::uint8_t channel) {
                   return entered != state && former(entered, channel);
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
/// Number of the server that a data frame is a request to.
inline std::optional<std::uint8_t> channel_of(const Parts& parts, const Frame& frame) {
  const SdoServer* server = is_base_data_frame(frame) ? parts.sdo.server_of(frame) : nullptr;
  return server == nullptr ? std::nullopt : std::optional(server->channel());
}

}  // namespace refnode::defect
