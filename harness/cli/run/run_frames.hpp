// SPDX-License-Identifier: Apache-2.0
// The frames of a run that is over.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "can/capture.hpp"
#include "result/run_result.hpp"

namespace conform::cli {

/// Where all frames of a run are in its bundle; those of its causes are in the same folder.
inline constexpr std::string_view bundled_frames = "captures/run.pcapng";

/// Of a capture file (pcapng), commented with what the run found. Error: it cannot be read.
[[nodiscard]] Result<can::LoadedCapture> commented_frames(const std::string& path,
                                                          const result::RunResult& run);

/// Whether the frames that decided something are those that stand in the capture at their places. Says which
/// one is not, or is empty.
[[nodiscard]] std::string why_not_of(const can::Capture& capture, const result::RunResult& run);

/// The first of these files, captures or bundles, that holds frames of this run. Error: none does, and why
/// not.
[[nodiscard]] Result<can::LoadedCapture> find_frames(const std::vector<std::string>& places,
                                                     const result::RunResult& run);

}  // namespace conform::cli
