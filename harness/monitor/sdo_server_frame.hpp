// SPDX-License-Identifier: Apache-2.0
// The fields of a server frame, for the two halves of the follower's server side.
#pragma once

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "can/frame.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/short_entries.hpp"
#include "monitor/sdo_channel.hpp"

namespace conform::monitor::server {

/// Bits 7-5 of the command: scs.
inline unsigned specifier(const can::Frame& frame) { return frame.data[0] >> 5U; }
inline AbortCode code_of(const can::Frame& frame) {
  return AbortCode(static_cast<std::uint32_t>(load_le(ByteView(frame.data).subspan(4, 4))));
}
/// 80h; with reserved bits set only where a code of the standard follows: 81h to 9Fh also begin the last
/// segment of a block upload.
inline bool is_abort(const can::Frame& frame) {
  return frame.data[0] == 0x80 || (specifier(frame) == 4 && !canopen::meaning(code_of(frame)).empty());
}
/// A segment of a block upload, as far as its first byte tells: a frame that is nothing else.
inline bool may_be_block_segment(const can::Frame& frame) {
  return frame.data[0] != 0 && frame.data[0] != 0x80 && !is_abort(frame);
}
inline std::uint32_t long_of(const can::Frame& frame) { return code_of(frame).value(); }

/// What `frame` names against what it should.
inline SdoAnswer::Mux compare(Multiplexer wanted, const can::Frame& frame) {
  const auto got = multiplexer_of(frame);
  return {wanted, got, wanted == got};
}
/// The object of an initiate request.
inline Multiplexer object_of(const SdoChannel::Data& initiate) {
  can::Frame frame;
  frame.data = initiate;
  return multiplexer_of(frame);
}

/// Bits of an initiate request that mean nothing (7.2.4.3.3 to 7.2.4.3.15): some servers take it for an
/// unknown command, and then its multiplexer for none.
inline bool has_reserved_bits(const SdoChannel::Data& initiate) {
  switch (initiate[0] >> 5U) {
    case 1: return (initiate[0] & 0x10U) != 0;
    case 2: return (initiate[0] & 0x1FU) != 0;
    case 5:
    case 6: return (initiate[0] & 0x18U) != 0;
    default: return false;
  }
}

/// The value of an initiate frame with e = 1: n unused bytes if s says so, else as many as the entry has not.
inline SdoChannel::Value expedited_value(Multiplexer object, const SdoChannel::Data& data) {
  const bool is_told = (data[0] & 0x01U) != 0;
  const auto size = is_told ? 4U - ((data[0] >> 2U) & 3U) : canopen::length_of_short_entry(object);
  return {object, static_cast<std::uint32_t>(load_le(ByteView(data).subspan(4, size))),
          static_cast<std::uint8_t>(is_told ? size : 0)};
}

}  // namespace conform::monitor::server
