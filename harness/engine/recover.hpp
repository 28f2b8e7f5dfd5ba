// SPDX-License-Identifier: Apache-2.0
// Puts back what another process changed in a device and could not put back itself.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/observer.hpp"
#include "engine/restore.hpp"

namespace conform::engine {

/// What a killed run left behind.
struct Remains {
  std::vector<Change> changes;
  /// Entries of 1010h by which the values are stored once they are back, because test values were stored, or
  /// defaults were restored, and would come back with the next reset.
  std::vector<Multiplexer> store;
  /// Numbers by which the device is known (1018h). The journal of an interface and node-ID may be that of
  /// another device, whose values are not written into this one.
  std::vector<std::pair<Multiplexer, std::uint64_t>> identity;
};

struct Recovery {
  RestoreReport values;
  std::vector<Multiplexer> stored;
  std::vector<std::string> not_stored;  ///< "1010h:01: abort 0606 0000h (hardware error)"
};

/// Finds the device in whatever state it was left, ends what is open, restores and stores. Error: the
/// environment failed, the device does not answer, or it is another one; then nothing was written.
[[nodiscard]] Result<Recovery> recover(can::Transport& transport, const device::Profile& profile,
                                       Remains remains, Observer& observer);

}  // namespace conform::engine
