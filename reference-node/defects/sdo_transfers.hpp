// SPDX-License-Identifier: Apache-2.0
// What the tables of SDO defects ask of a segmented transfer, and do to its answers.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "defects/sdo_exchanges.hpp"
#include "defects/tools.hpp"

namespace refnode::defect {

/// Which segmented transfer of the conformant server is running, seen from the exchanges.
struct Transfer {
  enum class Direction : std::uint8_t { none, upload, download };
  Direction running = Direction::none;

  void see(const SdoExchange& exchange, const std::vector<Outgoing>& frames);
};

/// Runs `change` on the frames of an exchange that met a running transfer of the given direction.
[[nodiscard]] Filter during(Transfer::Direction direction, Condition when,
                            void (*change)(const SdoExchange&, std::vector<Outgoing>&));
/// A transfer of this direction that is left alone is not aborted, and the requests that come then are not
/// answered for a while.
[[nodiscard]] Filter stuck_when_abandoned(Transfer::Direction direction);

inline bool any_toggle(const std::function<bool(bool, bool)>&, bool, bool) { return true; }

inline void drop(const SdoExchange&, std::vector<Outgoing>& frames) { frames.clear(); }

/// The frames' data in place of what the server answered.
inline void answer(std::vector<Outgoing>& frames, const Data& data) {
  for (Outgoing& outgoing : frames) outgoing.frame.data = data;
}

}  // namespace refnode::defect
