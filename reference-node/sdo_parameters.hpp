// SPDX-License-Identifier: Apache-2.0
// The parameters of additional SDO servers (1201h, 1202h) and of an SDO client (1280h), CiA 301, 7.5.2.33
// and 7.5.2.34. The client parameter is data only: the node never sends a request.
#pragma once

#include <cstdint>

#include "cob_id_rules.hpp"
#include "device.hpp"

namespace refnode {

/// The two COB-IDs of a channel, named by what the node does: it receives one and sends the other.
struct SdoChannel {
  CobIdRules receive;
  CobIdRules transmit;
  /// Both have bit 31 = 0.
  [[nodiscard]] bool valid() const { return receive.valid() && transmit.valid(); }
};

/// Adds 1200h + `number` and gives its channel. While bit 30 (dynamic) of one COB-ID is set nothing of the
/// object is stored.
[[nodiscard]] SdoChannel add_sdo_server(Device& device, std::uint8_t number);
void add_sdo_client(Device& device);

}  // namespace refnode
