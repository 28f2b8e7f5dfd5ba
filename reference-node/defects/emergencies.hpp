// SPDX-License-Identifier: Apache-2.0
// What the tables of EMCY defects ask of a message, and the rules that they change.
#pragma once

#include "defects/hooks.hpp"

namespace refnode::defect {

inline EmergencyRules& of_emergency_rules(Parts& parts) { return parts.emergency.rules; }

inline bool is_error_reset(const Outgoing& outgoing) {
  return outgoing.frame.data[0] == 0 && outgoing.frame.data[1] == 0;
}

}  // namespace refnode::defect
