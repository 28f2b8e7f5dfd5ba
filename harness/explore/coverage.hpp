// SPDX-License-Identifier: Apache-2.0
// What a conversation has made of the device, as far as its answers tell: abstract states, by which the
// search knows a conversation that has come somewhere new.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "explore/action.hpp"
#include "explore/side.hpp"

namespace conform::explore {

/// One number for each action that was answered: the NMT state, the timers that run, the services that have
/// been switched, and what came of the action. Equal numbers are equal states.
[[nodiscard]] std::vector<std::uint64_t> states_of(std::span<const Action> conversation,
                                                   std::span<const Answer> answers, NodeId node);

}  // namespace conform::explore
