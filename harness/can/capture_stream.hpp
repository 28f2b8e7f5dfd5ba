// SPDX-License-Identifier: Apache-2.0
// A capture file that grows with the run, so that a kill costs no more than the frames of the last moment.
#pragma once

#include <optional>
#include <string>

#include "base/error.hpp"
#include "can/capture.hpp"
#include "can/descriptor.hpp"

namespace conform::can {

/// Frames wait for this long, in time of the bus, before they are appended together: one write for each would
/// cost more than the frame itself.
inline constexpr Duration longest_in_stream = std::chrono::milliseconds(50);

class CaptureStream {
 public:
  enum class Format : std::uint8_t { pcapng, candump };

  /// Replaces the file by one without frames.
  [[nodiscard]] static Result<CaptureStream> create(std::string path, Format format, CaptureInfo info);

  void add(const CapturedFrame& frame);
  /// Nothing came until now.
  void waited(BusTime now) {
    if (oldest_ && now - *oldest_ >= longest_in_stream) flush();
  }
  void flush();
  /// errno of the first write that failed, 0 while all is well.
  [[nodiscard]] int error() const { return error_; }

 private:
  CaptureStream(Descriptor file, Format format, CaptureInfo info)
      : file_(std::move(file)), format_(format), info_(std::move(info)) {}

  Descriptor file_;
  Format format_;
  CaptureInfo info_;
  Bytes bytes_;                    ///< pcapng that is not written yet
  std::string text_;               ///< candump that is not written yet
  std::optional<BusTime> oldest_;  ///< of the frames that are not written yet
  int error_ = 0;
};

}  // namespace conform::can
