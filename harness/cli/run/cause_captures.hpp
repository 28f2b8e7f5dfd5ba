// SPDX-License-Identifier: Apache-2.0
// The folder with one capture for each cause of a run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "can/capture.hpp"
#include "result/run_result.hpp"

namespace conform::cli {

/// Makes the folder, or removes what an earlier run has put there: files with the name of a capture of a
/// cause that this program has written, and nothing else. Error: it is no folder, or cannot be written to.
[[nodiscard]] Result<void> empty_capture_folder(const std::string& folder);

/// Whether the folder has the captures of all causes of this run already, by their names.
[[nodiscard]] bool has_cause_captures(const std::string& folder, const result::RunResult& run);

/// A file of that folder: pcapng.
struct CauseCapture {
  std::string name;
  std::vector<std::uint8_t> bytes;
};

/// The captures of all causes of the run: the case each is told with, from its preparation until what it
/// changed is put back, the frames that show the finding, and some before and behind. Error: the capture has
/// less frames than the run.
[[nodiscard]] Result<std::vector<CauseCapture>> cause_captures(const result::RunResult& run,
                                                               const can::Capture& capture,
                                                               const can::CaptureInfo& info);

/// Writes them into the folder, in the place of those of an earlier run (see empty_capture_folder); no name
/// of a folder: nothing is done. Error: a file that somebody else has put there has the name of one of them,
/// and nothing was written or removed; or the first file that could not be written.
[[nodiscard]] Result<void> write_cause_captures(const std::string& folder,
                                                const std::vector<CauseCapture>& captures);

}  // namespace conform::cli
