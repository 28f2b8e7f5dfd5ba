// SPDX-License-Identifier: Apache-2.0
// Which SDO transfers of ours are open, by what is on the bus.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "base/strong.hpp"
#include "can/frame.hpp"

namespace conform::cli {

/// Fed with the frames of both sides in their order. A request that nobody has answered is open as well: the
/// server may have begun.
class OpenTransfers {
 public:
  struct Transfer {
    CanId request;  ///< CAN-ID
    Multiplexer object;
  };

  void sent(const can::Frame& frame);
  void received(const can::Frame& frame);
  /// All of them are gone: the device was reset, or had no power.
  void forget() { channels_.clear(); }

  [[nodiscard]] std::vector<Transfer> all() const;
  /// Whether the server takes whatever is sent there for segments of a block download.
  [[nodiscard]] bool takes_segments(std::uint32_t request) const;

 private:
  enum class Kind : std::uint8_t { upload, download, block_upload, block_download };
  struct Channel {
    Kind kind = Kind::upload;
    Multiplexer object;
    bool answer_ends = false;   ///< the answer to the latest request is the last frame of the transfer
    bool streams = false;       ///< of a block transfer: segments are under way
    bool last_segment = false;  ///< of a block download: the latest one says that it is the last
    std::uint8_t number = 0;    ///< ... and has this number
  };
  static void answer(std::map<std::uint32_t, Channel>& channels,
                     std::map<std::uint32_t, Channel>::iterator open, const can::Frame& frame);

  std::map<std::uint32_t, Channel> channels_;  ///< by the number of the node on whose channel they are
};

}  // namespace conform::cli
