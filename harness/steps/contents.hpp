// SPDX-License-Identifier: Apache-2.0
// What a row of frames says beside when it comes: counters of SYNC and times of day.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/time.hpp"
#include "can/capture.hpp"

namespace conform::steps {

using CapturedFrames = std::span<const can::CapturedFrame* const>;

/// How many bytes each of them has, where all have as many; at least one frame.
[[nodiscard]] std::optional<std::size_t> common_length(CapturedFrames frames);

/// Frames that do not go on counting from the one before, 1 to `overflow` and 1 again (CiA 301, 7.2.5.2.2).
/// The first may begin anywhere in between. A frame that has not one byte counts nothing.
[[nodiscard]] std::size_t out_of_order(CapturedFrames frames, std::uint64_t overflow);

/// TIME_OF_DAY (CiA 301, 7.1.6.5) in six bytes.
struct TimesOfDay {
  std::size_t malformed = 0;  ///< another length, reserved bits, or more milliseconds than a day has
  /// How far the times told are from the times of the frames, counted from the first frame on.
  Duration drift{};
};
[[nodiscard]] TimesOfDay times_of_day(CapturedFrames frames);

}  // namespace conform::steps
