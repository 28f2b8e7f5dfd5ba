// SPDX-License-Identifier: Apache-2.0
// What a replay may do to a device.
#pragma once

#include "base/error.hpp"
#include "cli/replay/differences.hpp"
#include "device/profile.hpp"
#include "steps/tier.hpp"

namespace conform::cli {

/// Whether the tier covers every frame, and the profile lets every entry be written that a frame writes; a
/// segment of a block download counts as the request that it looks like as well.
/// Error (of the user): the first frame that it does not, by its number, and what would let it.
[[nodiscard]] Result<void> may_replay(const Side& then, const device::Profile& profile, steps::Tier allowed);

}  // namespace conform::cli
