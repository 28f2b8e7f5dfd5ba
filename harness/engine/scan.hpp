// SPDX-License-Identifier: Apache-2.0
// What a device shows of its object dictionary to somebody who only reads: the raw material of a draft EDS.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/run_session.hpp"

namespace conform::engine {

/// Inclusive.
struct IndexRange {
  std::uint16_t first = 0, last = 0;
};

struct ScannedEntry {
  Multiplexer mux;
  std::optional<Bytes> value;      ///< absent: it is there, but could not be read
  std::optional<AbortCode> abort;  ///< why not; neither: it is too long to be read whole, or no answer came
  bool size_open = false;          ///< the device did not say how many of the four bytes are data
};

struct ScannedObject {
  Index index;
  std::vector<ScannedEntry> entries;  ///< ascending; one with sub-index 00h: a VAR, as far as one can see
};

/// Uploads every sub-index 00h of the ranges and, where there is something, the sub-indices up to the number
/// that 00h tells; an object whose 00h tells no number is asked for 01h, and that is all. Reads only.
/// `progress` is called before each 100h indices. Error: the environment failed, or the device fell silent.
[[nodiscard]] Result<std::vector<ScannedObject>> scan(RunSession& session, std::span<const IndexRange> ranges,
                                                      const std::function<void(Index)>& progress);

}  // namespace conform::engine
