// SPDX-License-Identifier: Apache-2.0
// What a communication error does to the NMT state (1029h; CiA 301, 7.5.2.32).
#pragma once

#include <cstdint>
#include <functional>

#include "device/device.hpp"

namespace refnode {

/// 00h, and without 1029h: from Operational to Pre-operational. 01h: no change. 02h: to Stopped.
[[nodiscard]] NmtState state_after_error(std::uint64_t class_value, NmtState present);

struct ErrorBehaviourRules {
  /// The state after a communication error; `class_value` is that of 1029h:01.
  Rule<NmtState(std::uint64_t class_value, NmtState present)> next_state{state_after_error};
};

class ErrorBehaviour {
 public:
  explicit ErrorBehaviour(Device& device) : device_(&device) {}

  ErrorBehaviourRules rules;

  std::function<void(NmtState)> enter;  ///< asks the NMT slave for another state

  /// 1029h
  void add_objects();

  /// A heartbeat or the guarding stayed away.
  void on_communication_error();

 private:
  Device* device_;
};

}  // namespace refnode
