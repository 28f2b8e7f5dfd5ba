// SPDX-License-Identifier: Apache-2.0
// What a device shows of its object dictionary: the raw material of a draft EDS, and of a comparison with
// one.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "engine/run_session.hpp"
#include "steps/tier.hpp"

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
  /// What the device made of its own value written back; absent: not tried, or the refusal said nothing.
  std::optional<bool> writable = {};
};

struct ScannedObject {
  Index index;
  std::vector<ScannedEntry> entries;  ///< ascending; one with sub-index 00h: a VAR, as far as one can see
};

struct ScanOptions {
  std::vector<IndexRange> ranges;
  /// The highest tier to take. From `config` on the communication objects (1000h to 1FFFh) get their own
  /// value written back, to see whether 0601 0002h (read-only) comes; with `motion` the others, too. What a
  /// write has an effect of is never written: commands, 1010h, 1011h, program control.
  steps::Tier allow = steps::Tier::read_only;
  std::set<Multiplexer> skip;           ///< neither read nor written
  std::vector<Multiplexer> also;        ///< looked at besides, wherever they are
  std::function<void(Index)> progress;  ///< called before each 100h indices; may be empty
};

/// Uploads every sub-index 00h of the ranges and, where there is something, the sub-indices up to the number
/// that 00h tells; an object whose 00h tells no number is asked for 01h, and that is all. Where 00h counts
/// something else (1003h, mappings) it goes on to the first sub-index that is not there. Reads only, unless
/// more is allowed. Error: the environment failed, or the device fell silent.
[[nodiscard]] Result<std::vector<ScannedObject>> scan(RunSession& session, const ScanOptions& options);

}  // namespace conform::engine
