// SPDX-License-Identifier: Apache-2.0
#include "nmt/nmt_slave.hpp"

namespace refnode {

namespace {

constexpr std::uint8_t command_start = 0x01;
constexpr std::uint8_t command_stop = 0x02;
constexpr std::uint8_t command_pre_operational = 0x80;
constexpr std::uint8_t command_reset_node = 0x81;
constexpr std::uint8_t command_reset_communication = 0x82;

}  // namespace

bool NmtSlave::addressed(const Frame& frame) const {
  const Behaviour& behaviour = device_->behaviour;
  if (frame.size() < 2 && behaviour.nmt_short_frame_accepted) return frame.size() == 1;
  if (frame.size() > 2 && behaviour.nmt_long_frame_accepted) return true;
  if (frame.size() != 2) return false;
  if (behaviour.nmt_node_id_unchecked) return true;
  if (frame.data[1] == 0) return !behaviour.nmt_broadcast_ignored;
  const std::uint8_t target = behaviour.nmt_node_id_masked ? frame.data[1] & 0x7FU : frame.data[1];
  return target == device_->node_id;
}

bool NmtSlave::obeys_reset() const {
  const Behaviour& behaviour = device_->behaviour;
  switch (device_->state) {
    case NmtState::stopped: return !behaviour.nmt_reset_ignored_in_stopped;
    case NmtState::pre_operational: return !behaviour.nmt_reset_ignored_in_pre_operational;
    case NmtState::operational: return !behaviour.nmt_reset_ignored_in_operational;
    case NmtState::initialising: return true;
  }
  return true;
}

void NmtSlave::on_command(const Frame& frame) {
  if (!addressed(frame)) return;
  const NmtState state = device_->state;
  switch (frame.data[0]) {
    case command_reset_node:
      if (obeys_reset()) start_reset(Reset::node);
      return;
    case command_reset_communication:
      if (!device_->behaviour.nmt_reset_ignored_in_stopped || state != NmtState::stopped)
        start_reset(Reset::communication);
      return;
    default: break;
  }
  if (state == NmtState::initialising) return;
  const auto delay = std::chrono::milliseconds(device_->choices.nmt_latency_ms);
  if (delay.count() == 0) return obey(frame.data[0]);
  commands_.emplace_back(device_->now + delay, frame.data[0]);
}

void NmtSlave::obey(std::uint8_t command) {
  const Behaviour& behaviour = device_->behaviour;
  const NmtState state = device_->state;
  switch (command) {
    case command_start:
      if (behaviour.nmt_start_ignored_in_stopped && state == NmtState::stopped) return;
      return enter(behaviour.nmt_start_ignored ? state : NmtState::operational);
    case command_stop:
      if (behaviour.nmt_stop_ignored_in_pre_operational && state == NmtState::pre_operational) return;
      if (behaviour.nmt_stop_ignored_in_operational && state == NmtState::operational) return;
      return enter(NmtState::stopped);
    case command_pre_operational:
      if (behaviour.nmt_pre_operational_ignored && state == NmtState::operational) return;
      if (behaviour.nmt_pre_operational_resets && state == NmtState::pre_operational) {
        return start_reset(Reset::communication);
      }
      return enter(NmtState::pre_operational);
    default:
      if (behaviour.nmt_unknown_command_stops) enter(NmtState::stopped);
      return;
  }
}

void NmtSlave::start_reset(Reset reset) {
  if (device_->state == NmtState::initialising && boot_due_ &&
      device_->behaviour.reset_during_start_up_hangs) {
    boot_due_.reset();
    return;
  }
  device_->state = NmtState::initialising;
  restart_due_.reset();
  commands_.clear();
  if (on_reset) on_reset(reset);
  const Choices& choices = device_->choices;
  const int start_up = reset == Reset::node ? choices.node_start_up_ms : choices.communication_start_up_ms;
  boot_due_ = device_->now + std::chrono::milliseconds(start_up);
}

void NmtSlave::enter(NmtState state) {
  if (state == device_->state) return;
  const NmtState from = device_->state;
  device_->state = state;
  if (device_->behaviour.boot_up_on_pre_operational && state == NmtState::pre_operational) {
    device_->send(Service::boot_up,
                  conform::can::data_frame(conform::CanId(0x700U + device_->node_id), {0x00}));
  }
  if (on_change) on_change(from);
}

std::optional<BusTime> NmtSlave::next_wakeup() const {
  if (commands_.empty()) return earliest({boot_due_, restart_due_});
  return earliest({boot_due_, restart_due_, commands_.front().first});
}

void NmtSlave::on_time() {
  while (!commands_.empty() && commands_.front().first <= device_->now) {
    const std::uint8_t command = commands_.front().second;
    commands_.pop_front();
    obey(command);
  }
  if (restart_due_ && device_->now >= *restart_due_) start_reset(Reset::node);
  if (!boot_due_ || device_->now < *boot_due_) return;
  boot_due_.reset();
  if (device_->behaviour.restarts_after_ms > 0)
    restart_due_ = device_->now + std::chrono::milliseconds(device_->behaviour.restarts_after_ms);
  device_->send(Service::boot_up,
                conform::can::data_frame(conform::CanId(0x700U + device_->node_id), {0x00}));
  const bool starts = device_->behaviour.starts_in_operational || device_->choices.self_starting;
  device_->state = starts ? NmtState::operational : NmtState::pre_operational;
  if (on_boot_up) on_boot_up();
}

}  // namespace refnode
