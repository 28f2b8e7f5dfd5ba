// SPDX-License-Identifier: Apache-2.0
// SDO segments (CiA 301, 7.2.4.3.4, 7.2.4.3.6): ccc t nnn c, then seven bytes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "canopen/sdo_initiate.hpp"

namespace conform::canopen {

/// 60 or 70, then zeros.
[[nodiscard]] SdoBytes encode_upload_segment_request(bool toggle);
/// t<<4 | n<<1 | c and 0..7 data bytes; the rest is zero.
[[nodiscard]] SdoBytes encode_download_segment_request(bool toggle, ByteView data, bool last);

/// A segment with data: upload response (scs 0) or download request (ccs 0).
struct Segment {
  bool toggle = false;
  std::uint8_t unused = 0;  ///< n: bytes at the end without data
  bool last = false;        ///< c: no more segments
  std::array<std::uint8_t, 7> data{};
  [[nodiscard]] std::size_t size() const { return std::size_t{7} - unused; }
};
/// nullopt when shorter than eight bytes or another command.
[[nodiscard]] std::optional<Segment> decode_segment(ByteView bytes);

/// Download segment response: 20 or 30, seven reserved bytes.
struct SegmentAck {
  bool toggle = false;
  bool reserved_set = false;  ///< bits 0-3 or bytes 1-7 are not zero
};
[[nodiscard]] std::optional<SegmentAck> decode_download_segment_response(ByteView bytes);

}  // namespace conform::canopen
