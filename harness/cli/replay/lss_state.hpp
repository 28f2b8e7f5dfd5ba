// SPDX-License-Identifier: Apache-2.0
// Whether a part of a capture knows in which state the LSS slaves are that it speaks to.
#pragma once

#include "base/error.hpp"
#include "cli/replay/differences.hpp"

namespace conform::cli {

/// What only a slave in the configuration state obeys (node-ID, bit timing, store, inquire) needs a frame of
/// the part before it that says in which state the slaves are: a switch of all, a whole selection, the start
/// of a fastscan, or a reset of the device. Else it would reach whoever has been left in that state, or
/// nobody. Error (of the user): the first frame without one, and from which frame on to send.
[[nodiscard]] Result<void> lss_state_is_known(const Side& then, NodeId node);

}  // namespace conform::cli
