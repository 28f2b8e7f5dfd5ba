// SPDX-License-Identifier: Apache-2.0
// The state each case begins in, and the commands that lead there.
#pragma once

#include "canopen/nmt.hpp"
#include "engine/run_context.hpp"
#include "scenario/scenario.hpp"

namespace conform::engine {

/// Nothing is sent where the device cannot have left it since the last call; one that is still booting is
/// waited for.
[[nodiscard]] Result<void> enter_pre_operational(RunContext& run);
/// False: no boot-up message came.
[[nodiscard]] Result<bool> reset(RunContext& run, canopen::NmtCommand command);

/// SDO channel idle, freshly reset where the scenario asks for it, and Pre-operational, as far as the run may
/// command.
[[nodiscard]] Result<void> reach_baseline(RunContext& run, const scenario::Scenario& scenario);

}  // namespace conform::engine
