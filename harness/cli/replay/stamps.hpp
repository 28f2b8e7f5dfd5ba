// SPDX-License-Identifier: Apache-2.0
// When the frames of a capture came, for who wants to keep their distances: a file may hold any stamps.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/time.hpp"
#include "can/capture.hpp"
#include "cli/replay/differences.hpp"

namespace conform::cli {

/// A replay waits for nothing that took longer. No case is idle for so long; a damaged file may claim years.
inline constexpr Duration longest_gap = std::chrono::hours(1);

/// The times of the frames [first, end) on a clock that begins with the first and is never set back.
class SteadyTimes {
 public:
  SteadyTimes(std::span<const can::CapturedFrame> frames, std::size_t first, std::size_t end);

  /// `index`: in the capture.
  [[nodiscard]] BusTime at(std::size_t index) const { return times_[index - first_]; }
  /// Capture indices of frames whose stamps are before those of the frames before them, by more than frames
  /// overtake each other on their way to the file: the clock was set back, and no time counts there.
  [[nodiscard]] const std::vector<std::size_t>& set_back() const { return set_back_; }

 private:
  std::size_t first_;
  std::vector<BusTime> times_;
  std::vector<std::size_t> set_back_;
};

/// Error: between two frames of ours, or one of them and an answer, lies more than longest_gap.
[[nodiscard]] Result<void> gaps_are_bounded(const Side& then);

/// "the stamps run back at frame 13, by 2 s: ..."; empty: they do not.
[[nodiscard]] std::string set_back_note(const Side& then);

}  // namespace conform::cli
