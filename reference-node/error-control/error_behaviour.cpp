// SPDX-License-Identifier: Apache-2.0
#include "error-control/error_behaviour.hpp"

namespace refnode {

namespace {

constexpr std::uint64_t to_pre_operational = 0;
constexpr std::uint64_t no_change = 1;
constexpr std::uint64_t to_stopped = 2;

}  // namespace

NmtState state_after_error(std::uint64_t class_value, NmtState present) {
  switch (class_value) {
    case to_pre_operational: return present == NmtState::operational ? NmtState::pre_operational : present;
    case to_stopped: return NmtState::stopped;
    default: return present;
  }
}

void ErrorBehaviour::add_objects() {
  ObjectDictionary& od = device_->dictionary;
  od.add_complex(0x1029, "Error behaviour", ObjectKind::array);
  Entry& communication = od.add_sub(
      0x1029, 1, integer_entry("Communication error", DataType::unsigned8, Access::rw, to_pre_operational));
  communication.low = to_pre_operational;
  communication.high = to_stopped;
  // Of the profile (CiA 401). The outputs of this node cannot fail, so there is nothing to choose.
  od.add_sub(0x1029, 2, integer_entry("Output error", DataType::unsigned8, Access::constant, no_change));
}

void ErrorBehaviour::on_communication_error() {
  const std::uint64_t communication = device_->dictionary.number(0x1029, 1, to_pre_operational);
  if (enter) enter(rules.next_state(communication, device_->state));
}

}  // namespace refnode
