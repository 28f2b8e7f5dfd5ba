// SPDX-License-Identifier: Apache-2.0
// What a row of time stamps says: distances between frames, and frames as answers to what was sent.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

#include "base/time.hpp"

namespace conform::steps {

/// So long a reply to a guard request is waited for. No rule says when it is due, and a computer that does
/// other things as well lets a device that runs on it wait for more than T_NMT of a quick one.
[[nodiscard]] inline Duration guard_patience(Duration nmt_time) {
  return std::max<Duration>(nmt_time, std::chrono::milliseconds(100));
}

/// Distances between the frames of a window.
struct Distances {
  Duration mean{}, shortest{};  ///< of frames that follow each other; meaningless below two frames
  /// Also the time behind the last frame: a producer that has fallen silent does not keep its period.
  Duration longest{};
};
/// `frames` in the order of time, at least one; `end` of the window.
[[nodiscard]] Distances distances_of(std::span<const BusTime> frames, BusTime end);

/// Frames as answers: each belongs to the last stimulus (a SYNC, mostly) before it. So a stimulus that the
/// host sent late is not counted against the device.
struct Answers {
  std::size_t missed = 0;   ///< stimuli without a frame before the next one
  std::size_t skipped = 0;  ///< of those the ones before the first that was answered
  std::size_t extra = 0;    ///< frames beyond the first of a stimulus, and frames before the first stimulus
  /// Stimuli from one answered one to the next. The ones before the first and behind the last answer count
  /// in the longest: three unanswered SYNCs at the end are at least a distance of four.
  std::size_t shortest = 0, longest = 0;
  std::vector<Duration> latencies;  ///< sorted; from a stimulus to its first frame
};
/// Both in the order of time; at least one stimulus.
[[nodiscard]] Answers answers_of(std::span<const BusTime> stimuli, std::span<const BusTime> frames);

}  // namespace conform::steps
