// SPDX-License-Identifier: Apache-2.0
// What the follower of an SDO channel knows about one frame of the server. Everything optional is absent
// where the trace leaves it open: a monitor judges only what is there.
#pragma once

#include <cstdint>
#include <optional>

#include "base/strong.hpp"

namespace conform::monitor {

/// What the client asked for, as far as one request can be named.
enum class Asked : std::uint8_t {
  nothing,
  download,            ///< initiate, ccs 1
  download_segment,    ///< ccs 0
  upload,              ///< initiate, ccs 2
  upload_segment,      ///< ccs 3
  block_upload,        ///< initiate
  block_upload_end,    ///< the acknowledge of the last sub-block, which asks for the end frame
  block_download,      ///< initiate
  block_download_ack,  ///< the last segment of a sub-block
  block_download_end,  ///< the end frame of the client
  other,               ///< unknown command specifier, sub-command out of place, frame that is no request
};

struct SdoAnswer {
  /// What the frame is a reaction to.
  enum class To : std::uint8_t {
    unclear,  ///< the trace does not tell: several requests at once, frames that are no requests, lost frames
    request,  ///< one request, named by `asked`
    several,  ///< one of several requests
    stream,   ///< a segment of a block upload that the client started
    itself,   ///< an abort of an open transfer, which a server may send at any time
    nothing,  ///< nobody asked
  };
  /// Nobody asked, but something came before that explains it.
  enum class Cause : std::uint8_t {
    none,
    idle_abort,
    client_abort,
    repeated_abort,
    foreign,
    broadcast,
    extended,
    own_id
  };

  struct Mux {
    Multiplexer wanted, got;
    bool right = false;
    bool free = false;  ///< the standard names none: it should still belong to the request or to its transfer
  };
  struct Toggle {
    bool wanted = false, got = false;
  };
  struct Size {
    std::uint64_t announced = 0, delivered = 0;
  };
  struct Segment {  ///< of a block upload
    std::uint8_t wanted = 0, got = 0, block_size = 0;
    bool too_many = false;  ///< the sub-block was complete
  };
  struct End {            ///< end frame of a block upload
    bool agreed = false;  ///< both sides want the CRC
    std::uint16_t got = 0;
    std::optional<std::uint16_t> wanted;  ///< CRC over the data seen
    std::uint8_t unused = 0;
    std::optional<std::uint8_t> unused_wanted;  ///< n that the announced size asks for
  };

  bool well_formed = false;  ///< a data frame with DLC 8
  bool default_channel = true;
  bool block = false;  ///< an answer of the block protocols, or it may be one
  To to = To::unclear;
  Cause cause = Cause::none;
  Asked asked = Asked::nothing;
  std::optional<Mux> mux;        ///< of initiate responses and of aborts
  std::optional<Toggle> toggle;  ///< of segment responses
  std::optional<Size> size;      ///< at the end of a transfer, or when more came than was announced
  std::optional<Segment> segment;
  std::optional<End> end;
  std::optional<std::uint8_t> block_size;  ///< given by the server of a block download
};

}  // namespace conform::monitor
