// SPDX-License-Identifier: Apache-2.0
// An SDO transfer as a whole: what is asked for, how, and what the client does wrong on the way.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "canopen/sdo_block.hpp"
#include "canopen/sdo_client.hpp"
#include "canopen/sdo_fault.hpp"
#include "canopen/sdo_transfer.hpp"

namespace conform::canopen {

struct SdoRequest {
  bool upload = true;
  Multiplexer object{};
  Bytes data{};                                           ///< download
  bool block = false;                                     ///< a block transfer
  SdoDownload::Mode mode = SdoDownload::Mode::automatic;  ///< download, not by block
  bool size_told = true;                                  ///< block download
  std::optional<std::uint32_t> announced{};    ///< download: the size to tell in place of the true one
  std::uint8_t blksize = most_block_segments;  ///< block upload, legal or not
  std::uint8_t pst = 0;                        ///< block upload
  bool crc = true;                             ///< block: ask for the CRC
  std::vector<SdoFault> faults{};
  std::size_t max_bytes = most_upload_bytes;
  std::optional<std::size_t> enough{};  ///< upload by segments: bytes after which a long value is given up
};

/// Error (of the scenario) when a fault has no place in the transfer, or the data do not fit its mode.
[[nodiscard]] Result<std::unique_ptr<SdoClient>> make_sdo_client(const SdoRequest& request);

}  // namespace conform::canopen
