// SPDX-License-Identifier: Apache-2.0
// Sends what the harness sent once more, in the same order and spacing.
#pragma once

#include <functional>
#include <span>

#include "base/error.hpp"
#include "base/time.hpp"
#include "can/capture.hpp"
#include "cli/replay/dialogue.hpp"
#include "cli/replay/section.hpp"
#include "device/profile.hpp"
#include "engine/recorder.hpp"
#include "steps/tier.hpp"

namespace conform::cli {

/// Whether the tier covers every frame, and the profile lets every entry be written that a frame writes.
/// Error (of the user): the first frame that it does not, by its number, and what would let it.
[[nodiscard]] Result<void> may_replay(std::span<const can::CapturedFrame> frames, const Dialogue& recorded,
                                      const device::Profile& profile, steps::Tier allowed);

struct Played {
  std::size_t first = 0;  ///< capture index of the recorder: nothing before it belongs to the replay
  std::size_t end = 0;    ///< where the recorded part is over; what comes behind it is late
};

/// Frames go out as long after the frame or the answer before them as they did then. What was answered waits
/// for its answer: T_SDO and the like of the profile at most, or twice as long as the answer took then, if
/// that is longer. An abort in place of what was recorded ends the wait for the rest of a transfer. `power`:
/// switches the power of the device where that was done then; empty: it cannot be. Error: the environment
/// failed.
[[nodiscard]] Result<Played> play(engine::Recorder& recorder, std::span<const can::CapturedFrame> frames,
                                  const Section& section, const Dialogue& recorded,
                                  const device::Profile& profile, const std::function<Result<void>()>& power);

}  // namespace conform::cli
