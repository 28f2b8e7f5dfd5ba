// SPDX-License-Identifier: Apache-2.0
// Puts back what another process changed in a device and could not put back itself.
#pragma once

#include "engine/observer.hpp"
#include "engine/restore.hpp"

namespace conform::engine {

/// Finds the device in whatever state it was left, ends what is open, and restores. Error: the environment
/// failed, or the device does not answer.
[[nodiscard]] Result<RestoreReport> recover(can::Transport& transport, const device::Profile& profile,
                                            std::vector<Change> changes, Observer& observer);

}  // namespace conform::engine
