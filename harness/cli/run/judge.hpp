// SPDX-License-Identifier: Apache-2.0
// The monitors over a recorded trace.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "can/capture.hpp"
#include "device/profile.hpp"
#include "result/run_result.hpp"
#include "scenario/catalogue.hpp"
#include "scenario/selection.hpp"

namespace conform::cli {

struct Recording {
  can::Capture capture;
  can::CaptureInfo info;
  /// The file names no frame as sent by the host that recorded it, so that identifiers have to tell.
  bool directions_inferred = false;
  /// Bytes of an unfinished block or line at the end of the file, left out.
  std::size_t cut_off = 0;
};

/// pcapng or candump log, told by the content. `only`: the interface, where the file has several. Where no
/// frame is marked as sent, what only clients and masters send is taken as sent.
[[nodiscard]] Result<Recording> read_recording(std::string_view content, const std::string& where,
                                               std::string_view only);

struct JudgeOptions {
  scenario::Selection selection;
  bool strict = false;
  /// Today, by which waivers expire.
  std::chrono::sys_days today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
};
[[nodiscard]] result::RunResult judge(const Recording& recording, const device::Profile& profile,
                                      const scenario::Catalogue& catalogue, const JudgeOptions& options);

}  // namespace conform::cli
