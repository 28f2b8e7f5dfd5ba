// SPDX-License-Identifier: Apache-2.0
#include "nmt/nmt_slave.hpp"

namespace refnode {

using namespace nmt_command;

namespace {

bool is_node_id(std::uint8_t value) { return value >= 1 && value <= 127; }

}  // namespace

NmtSlave::NmtSlave(Device& device)
    : rules{.start_up_time{[this](Reset reset) {
              return reset == Reset::node ? choices.node_start_up : choices.communication_start_up;
            }},
            .may_boot_up{is_node_id}},
      device_(&device) {}

bool NmtSlave::addressed(const Frame& frame) const {
  if (frame.size() != 2) return false;
  const std::uint8_t node_id = frame.data[1];
  return node_id == 0 || (node_id == device_->node_id && is_node_id(node_id));
}

void NmtSlave::on_command(const Frame& frame) {
  if (!addressed(frame)) return;
  const std::uint8_t command = frame.data[0];
  if (command == reset_node) return start_reset(Reset::node);
  if (command == reset_communication) return start_reset(Reset::communication);
  if (device_->state == NmtState::initialising) return;
  if (choices.latency == Duration::zero()) return obey(command);
  commands_.emplace_back(device_->now + choices.latency, command);
}

void NmtSlave::obey(std::uint8_t command) {
  switch (command) {
    case start: return enter(NmtState::operational);
    case stop: return enter(NmtState::stopped);
    case enter_pre_operational: return enter(NmtState::pre_operational);
    default: return;  // unknown
  }
}

void NmtSlave::start_reset(Reset reset) {
  device_->state = NmtState::initialising;
  commands_.clear();
  if (on_reset) on_reset(reset);
  boot_up_due_ = device_->now + rules.start_up_time(reset);
}

void NmtSlave::enter(NmtState state) {
  if (state == device_->state) return;
  const NmtState from = device_->state;
  device_->state = state;
  if (on_change) on_change(from);
}

std::optional<BusTime> NmtSlave::next_wakeup() const {
  if (commands_.empty()) return boot_up_due_;
  return earliest({boot_up_due_, commands_.front().first});
}

void NmtSlave::on_time() {
  while (!commands_.empty() && commands_.front().first <= device_->now) {
    const std::uint8_t command = commands_.front().second;
    commands_.pop_front();
    obey(command);
  }
  if (!boot_up_due_ || device_->now < *boot_up_due_) return;
  boot_up_due_.reset();
  if (!rules.may_boot_up(device_->node_id)) return;
  device_->send(Service::boot_up,
                conform::can::data_frame(conform::CanId(0x700U + device_->node_id), {0x00}));
  device_->state = choices.self_starting ? NmtState::operational : NmtState::pre_operational;
  if (on_boot_up) on_boot_up();
}

}  // namespace refnode
