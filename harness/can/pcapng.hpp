// SPDX-License-Identifier: Apache-2.0
// Captures for Wireshark: pcapng with link type CAN_SOCKETCAN, nanoseconds, directions and comments.
#pragma once

#include <string>
#include <string_view>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "can/capture.hpp"

namespace conform::can {

/// One section with one interface. Received frames (from the device) are marked inbound, own ones outbound;
/// comments become packet comments. Always little-endian, so the same capture gives the same bytes
/// everywhere.
[[nodiscard]] Bytes write_pcapng(const Capture& capture, const CaptureInfo& info);

/// The same in two parts, for a file that grows: what stands before the first frame, and one frame more.
[[nodiscard]] Bytes pcapng_head(const CaptureInfo& info);
void append_pcapng(Bytes& out, const CapturedFrame& frame, const CaptureInfo& info);

/// Name and version of the program that a file says it was written by, from its first bytes; empty: it says
/// none, or is no pcapng.
[[nodiscard]] std::string pcapng_application(ByteView head);

/// Reads pcapng of either byte order with CAN_SOCKETCAN interfaces; unknown blocks and options are skipped.
/// All frames must be of one interface: the one named `only` if given (others are then skipped), else the
/// first that has frames. `where` names the file in errors, which carry the byte offset.
[[nodiscard]] Result<LoadedCapture> read_pcapng(ByteView bytes, const std::string& where,
                                                std::string_view only = {});

}  // namespace conform::can
