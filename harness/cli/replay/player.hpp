// SPDX-License-Identifier: Apache-2.0
// Sends what the harness sent once more, in the same order and spacing.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/time.hpp"
#include "cli/replay/differences.hpp"
#include "device/profile.hpp"
#include "engine/recorder.hpp"

namespace conform::cli {

struct Played {
  std::size_t first = 0;         ///< capture index of the recorder: nothing before it belongs to the replay
  std::size_t recorded_end = 0;  ///< behind as much time as was recorded
  std::size_t end =
      0;  ///< the same, or later where the last request was ignored then: it may be answered now
  /// Indices into Dialogue::sent of what was not sent: segments of a block download that the device had left,
  /// and the rest of one that was aborted.
  std::vector<std::size_t> skipped;
  /// Capture indices of aborts that no frame of the old capture stands for, before `end`.
  std::vector<std::size_t> aborts;
  /// Where and why the replay left the recorded frames, in sentences.
  std::vector<std::string> notes;
};

/// Frames go out as long after the frame or the answer before them as they did then. What was answered waits
/// for its answer: T_SDO and the like of the profile at most, or twice as long as the answer took then, if
/// that is longer. An abort in place of what was recorded ends the wait for the rest of a transfer. `power`:
/// switches the power of the device where that was done then; empty: it cannot be. Error: the environment
/// failed, or the user stopped it; its hint says which frames were not sent.
/// A segment of a block download looks like any other request to a server that has left the transfer, and may
/// be taken for a write to any entry: where the server did not answer as it did then, segments are not sent,
/// and what it has left open is aborted. No transfer is left open, at the end or where it stops.
[[nodiscard]] Result<Played> play(engine::Recorder& recorder, const Side& then,
                                  const device::Profile& profile, const std::function<Result<void>()>& power);

}  // namespace conform::cli
