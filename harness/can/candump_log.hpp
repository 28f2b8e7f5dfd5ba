// SPDX-License-Identifier: Apache-2.0
// The log format of candump -l: greppable, replayed by canplayer, read by Wireshark, python-can and others.
#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "can/capture.hpp"

namespace conform::can {

/// Plain lines "(1700000000.005000) can0 605#4000100000000000" and nothing else: suffixes for the direction,
/// nine digits or comment lines each break at least one of the usual readers. So directions, comments,
/// nanoseconds and data length codes above eight are lost here; pcapng keeps them. Stamps before 1970 are
/// written as 0.
[[nodiscard]] std::string write_candump_log(const Capture& capture, const CaptureInfo& info);

/// One line of it, for a file that grows.
void append_candump_line(std::string& out, const CapturedFrame& frame, const CaptureInfo& info);

/// Reads what candump and we write: six or nine decimals, optional " T"/" R" for the direction (default:
/// received),
/// "_9".."_F" for a raw data length code. Empty lines and lines that start with '#' are skipped. All frames
/// must be of one interface: `only` if given (others are then skipped), else the first one named. `where`
/// names the file in errors, which carry the line number.
[[nodiscard]] Result<LoadedCapture> read_candump_log(std::string_view text, const std::string& where,
                                                     std::string_view only = {});

}  // namespace conform::can
