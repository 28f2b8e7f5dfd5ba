// SPDX-License-Identifier: Apache-2.0
// The default SDO server (CiA 301, 7.2.4): expedited and segmented transfers on 600h + node-ID / 580h +
// node-ID. Block transfer is not offered: its command specifiers are refused as unknown (0504 0001h).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "device.hpp"

namespace refnode {

class SdoServer {
 public:
  SdoServer(Device& device, Duration turnaround) : device_(&device), turnaround_(turnaround) {}

  /// A data frame on the request CAN-ID, in a state that serves SDO.
  void on_request(const Frame& frame);
  /// Drops a running transfer without a word.
  void reset() { transfer_.reset(); }

 private:
  struct Transfer {
    bool upload = true;
    Multiplexer mux;
    Bytes data;                            ///< upload: everything; download: received so far
    std::size_t position = 0;              ///< upload: next byte to send
    std::optional<std::size_t> announced;  ///< download: size of the initiate
    bool toggle = false;                   ///< toggle bit expected next
  };
  using Reply = std::optional<std::array<std::uint8_t, 8>>;

  Reply initiate_upload(SdoExchange& exchange);
  Reply upload_segment(SdoExchange& exchange);
  Reply initiate_download(SdoExchange& exchange);
  Reply download_segment(SdoExchange& exchange);
  Reply abort(SdoExchange& exchange, AbortCode code);

  Device* device_;
  Duration turnaround_;
  std::optional<Transfer> transfer_;
  std::array<std::uint8_t, 8> last_request_{};  ///< used by a defect only
};

}  // namespace refnode
