// SPDX-License-Identifier: Apache-2.0
// How single communication objects misbehave beyond what an edit of the dictionary can do.
#pragma once

namespace refnode {

/// 1029h: the reaction to a communication error.
struct ErrorBehaviourFaults {
  bool zero_stops = false;              ///< 00h ends in Stopped
  bool zero_acts_in_stopped = false;    ///< 00h leads from Stopped to Pre-operational
  bool one_leaves_operational = false;  ///< 01h acts like 00h
  bool two_ignored = false;             ///< 02h changes nothing
};

}  // namespace refnode
