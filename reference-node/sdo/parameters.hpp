// SPDX-License-Identifier: Apache-2.0
// The parameters of additional SDO servers (from 1201h on) and of SDO clients (from 1280h on), CiA 301,
// 7.5.2.33 and 7.5.2.34. A client parameter is data only: the node never sends a request.
#pragma once

#include <cstdint>

#include "cob-id/cob_id.hpp"
#include "device/device.hpp"

namespace refnode {

/// The two COB-IDs of a channel, named by what the node does: it receives one and sends the other.
struct SdoChannel {
  CobId receive;
  CobId transmit;
  /// Both have bit 31 = 0.
  [[nodiscard]] bool valid() const { return receive.valid() && transmit.valid(); }
};

inline constexpr std::uint16_t first_sdo_server = 0x1200;  ///< of the default server
inline constexpr std::uint16_t last_sdo_server = 0x127F;
inline constexpr std::uint16_t first_sdo_client = 0x1280;
inline constexpr std::uint16_t last_sdo_client = 0x12FF;

/// Adds 1200h + `number`.
void add_sdo_server(Device& device, std::uint8_t number);
/// Adds 1280h.
void add_sdo_client(Device& device);

/// Puts the rules behind the parameter of an additional server and gives its channel. While bit 30 (dynamic)
/// of one COB-ID is set nothing of the object is stored.
[[nodiscard]] SdoChannel bind_sdo_server(Device& device, const CobIdRules& rules, std::uint16_t index);
/// The same rules behind the parameters of all clients.
void bind_sdo_clients(Device& device, const CobIdRules& rules);

}  // namespace refnode
