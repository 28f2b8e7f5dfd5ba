// SPDX-License-Identifier: Apache-2.0
// The folder with one capture for each cause of a run.
#pragma once

#include <string>

#include "base/error.hpp"
#include "can/capture.hpp"
#include "result/run_result.hpp"

namespace conform::cli {

/// Makes the folder, or removes what an earlier run has put there: files with the name of a capture of a
/// cause that this program has written, and nothing else. Error: it is no folder, or cannot be written to.
[[nodiscard]] Result<void> empty_capture_folder(const std::string& folder);

/// Writes the captures of all causes of the run into the folder: the case each is told with, from its
/// preparation until what it changed is put back, the frames that show the finding, and some before and
/// behind. Error: the first file that could not be written.
[[nodiscard]] Result<void> write_cause_captures(const std::string& folder, const result::RunResult& run,
                                                const can::Capture& capture, const can::CaptureInfo& info);

}  // namespace conform::cli
