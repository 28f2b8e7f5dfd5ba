// SPDX-License-Identifier: Apache-2.0
// One capture for each cause: which frames are in it, and what it is called.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "result/causes.hpp"
#include "result/run_result.hpp"

namespace conform::result {

/// "cause-01-OD-1003-06-cia301-emergency-history-full.pcapng": a name for every file system. `number`: of the
/// cause in causes_of(), from 1.
[[nodiscard]] std::string capture_name(const Cause& cause, std::size_t number);
/// Whether it may be one of an earlier run: begins and ends like one.
[[nodiscard]] bool is_capture_name(std::string_view name);

/// Frames [first, end) of the capture of the run.
struct FrameRange {
  std::size_t first = 0;
  std::size_t end = 0;
};
/// The case that the cause is told with (of a monitor: the case that ran meanwhile) and the frames that show
/// the finding. nullopt: nothing of it is in the capture.
[[nodiscard]] std::optional<FrameRange> frames_of(const Cause& cause, const RunResult& run);
/// That case; nullptr: a monitor found it outside of all cases.
[[nodiscard]] const CaseResult* case_of(const Cause& cause, const RunResult& run);

}  // namespace conform::result
