// SPDX-License-Identifier: Apache-2.0
// A device description to begin with, made of what a scan of the device has shown.
#pragma once

#include <cstdint>
#include <ctime>
#include <span>
#include <string>

#include "base/strong.hpp"
#include "engine/scan.hpp"

namespace conform::cli {

struct DraftInfo {
  std::string file_name;       ///< for [FileInfo]; empty: "draft.eds"
  NodeId node{1};              ///< of the device: COB-IDs that hold it become formulas
  std::uint32_t bit_rate = 0;  ///< bit/s, 0: not known
  std::time_t made = 0;        ///< UTC
  bool access_tried = false;   ///< values were written back to see what is read-only
};

/// The EDS text (CiA 306), with CRLF line ends. Values are as they were read; what a scan cannot show is the
/// widest guess and said to be one in [Comments]: entries outside CiA 301 are rw where nobody tried, their
/// type is the UNSIGNED or the text of their length.
[[nodiscard]] std::string draft_eds(std::span<const engine::ScannedObject> objects, const DraftInfo& info);

}  // namespace conform::cli
