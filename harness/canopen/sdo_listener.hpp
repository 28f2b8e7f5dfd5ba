// SPDX-License-Identifier: Apache-2.0
// Names the frames of one SDO channel as a listener sees them. Segments of block transfers look like any
// other command, so that the open transfer has to be followed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/bytes.hpp"
#include "base/strong.hpp"

namespace conform::canopen {

class SdoListener {
 public:
  /// A data frame client to server: "SDO upload request 1003h:00".
  [[nodiscard]] std::string request(ByteView bytes);
  /// A data frame server to client: "SDO upload response 1000h:00 = 91 01 00 00 (4 bytes)".
  [[nodiscard]] std::string response(ByteView bytes);
  /// Forgets the open transfer (after a reset of the server).
  void reset() { *this = SdoListener{}; }

 private:
  enum class Phase : std::uint8_t { other, block_download, block_upload };
  [[nodiscard]] std::string object() const;
  [[nodiscard]] std::string abort(ByteView bytes);
  [[nodiscard]] std::string block_segment(ByteView bytes);
  [[nodiscard]] std::string block_request_of_upload(ByteView bytes);
  [[nodiscard]] std::string block_request_of_download(ByteView bytes);
  [[nodiscard]] std::string block_response_of_upload(ByteView bytes);
  [[nodiscard]] std::string block_response_of_download(ByteView bytes);

  std::optional<Multiplexer> open_;  ///< object of the running transfer
  Phase phase_ = Phase::other;       ///< who sends block segments now
  bool last_seen_ = false;           ///< a block segment with c = 1 has been seen
  std::uint8_t last_number_ = 0;     ///< number of the block segment seen last
};

}  // namespace conform::canopen
