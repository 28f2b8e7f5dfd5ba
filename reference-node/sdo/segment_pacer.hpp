// SPDX-License-Identifier: Apache-2.0
// When the next segment of a block upload may be handed over. Segments go out back to back, but one by one:
// an abort, a new request or an NMT command stops them at once. And because a server that never leaves a gap
// would keep every frame of lower priority off the bus, the client's abort among them, it pauses a few bit
// times after every row.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>

#include "base/time.hpp"

namespace refnode {

class SegmentPacer {
 public:
  using BusTime = conform::BusTime;
  using Duration = conform::Duration;

  /// A sub-block begins; its first segment goes out at `from`.
  void start(BusTime from) {
    from_ = from;
    in_row_ = 0;
    last_.reset();
  }
  /// `waiting`: frames of this node that are handed over and not on the wire yet.
  /// `whole`: as much of a sub-block as a deep queue takes is handed over at once, and no abort takes it
  /// back.
  [[nodiscard]] bool may_send(BusTime now, std::size_t waiting, bool whole) {
    if (whole) return now >= from_ && waiting < deep;
    if (in_row_ >= row && waiting == 0) start(now + pause());
    return now >= from_ && in_row_ < row && waiting < depth;
  }
  void on_segment() { ++in_row_; }
  /// A frame has left: the shortest distance of two is the time of one frame.
  void on_transmitted(BusTime now) {
    if (last_) frame_time_ = std::min(frame_time_, now - *last_);
    last_ = now;
  }
  [[nodiscard]] BusTime next() const { return from_; }

 private:
  static constexpr std::size_t depth = 2;  ///< one on the wire, one behind it: no gap
  static constexpr std::size_t deep = 64;
  static constexpr int row = 8;
  static constexpr Duration unknown = Duration::max();
  static constexpr Duration usual = std::chrono::milliseconds(1);  ///< at 125 kbit/s
  /// A frame of eight bytes has 111 to 135 bits: a sixteenth is more than the intermission of three, so that
  /// whoever waits gets in.
  [[nodiscard]] Duration pause() const {
    return (frame_time_ == unknown ? usual : frame_time_) / 16 + Duration(1);
  }

  BusTime from_{};
  int in_row_ = 0;
  std::optional<BusTime> last_;
  Duration frame_time_ = unknown;
};

}  // namespace refnode
