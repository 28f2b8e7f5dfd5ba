// SPDX-License-Identifier: Apache-2.0
#include "error-control/error_behaviour.hpp"

namespace refnode {

namespace {

constexpr std::uint64_t to_pre_operational = 0;  // from Operational only
constexpr std::uint64_t no_change = 1;
constexpr std::uint64_t to_stopped = 2;

}  // namespace

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
  const Behaviour& behaviour = device_->behaviour;
  const ErrorBehaviourFaults& fault = behaviour.error_behaviour;
  if (behaviour.consumer_loss_keeps_operational) return;
  const bool operational = device_->state == NmtState::operational;
  switch (device_->dictionary.number(0x1029, 1, to_pre_operational)) {
    case to_pre_operational:
      if (fault.zero_stops && operational) return nmt_->enter(NmtState::stopped);
      if (operational || (fault.zero_acts_in_stopped && device_->state == NmtState::stopped))
        nmt_->enter(NmtState::pre_operational);
      return;
    case no_change:
      if (fault.one_leaves_operational && operational) nmt_->enter(NmtState::pre_operational);
      return;
    case to_stopped:
      if (!fault.two_ignored) nmt_->enter(NmtState::stopped);
      return;
    default: return;  // reserved; taken by a defect only
  }
}

}  // namespace refnode
