// SPDX-License-Identifier: Apache-2.0
// The fields of a server frame, for the two halves of the follower's server side.
#pragma once

#include "base/bytes.hpp"
#include "base/strong.hpp"
#include "can/frame.hpp"
#include "monitor/sdo_channel.hpp"

namespace conform::monitor::server {

/// Bits 7-5 of the command: scs.
inline unsigned specifier(const can::Frame& frame) { return frame.data[0] >> 5U; }
inline bool is_abort(const can::Frame& frame) { return specifier(frame) == 4; }
inline AbortCode code_of(const can::Frame& frame) {
  return AbortCode(static_cast<std::uint32_t>(load_le(ByteView(frame.data).subspan(4, 4))));
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

}  // namespace conform::monitor::server
