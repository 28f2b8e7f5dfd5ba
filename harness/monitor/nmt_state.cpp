// SPDX-License-Identifier: Apache-2.0
#include "monitor/nmt_state.hpp"

namespace conform::monitor {

void NmtState::spoke(BusTime time) {
  // What others kept from being sent waits in one go with the first frame that came through.
  if (time > spoke_at_ + longest_frame) queue_began_ = made_since(time);
  spoke_at_ = time;
}

void NmtState::answered(BusTime asked, std::uint32_t can_id) {
  answered_since_ = asked;
  answers_with_ = can_id;
}

void NmtState::bus_was_taken(BusTime time) {
  if (time > taken_at_ + pause_of_none) taken_since_ = time;
  taken_at_ = time;
}

void NmtState::command(const can::Frame& frame, BusTime time, std::size_t index) {
  using canopen::NmtCommand;
  if (frame.extended || frame.remote || frame.dlc != 2) {
    // No command; some devices obey longer frames.
    commanded_.reset();
    return;
  }
  const auto node = frame.data[1];
  if (node != 0 && node != facts_.node.value()) return;
  const auto command = canopen::nmt_command_at(frame.data[0]);
  commanded_.reset();
  if (!command) return;
  if (canopen::is_reset(*command)) {
    // Perhaps it has another node-ID now, and obeys only what is told to all.
    if (moved_ && node != 0) return;
    // What came long ago is settled: only resets close together may share a boot-up message.
    resets_ = time > reset_at_ + facts_.boot_time ? 1 : resets_ + 1;
    booting_ = true;
    last_reset_ = command;
    reset_at_ = time;
    reset_index_ = index;
    return;
  }
  ordered_at_ = time;
  // While it boots a device may miss commands, and with another node-ID those to the one that it had.
  if (booting_ || readdressed_ || (booted_at_ && time <= *booted_at_ + facts_.deaf_time)) return;
  commanded_at_ = time;
  commanded_ = *command == NmtCommand::start  ? canopen::NmtState::operational
               : *command == NmtCommand::stop ? canopen::NmtState::stopped
                                              : canopen::NmtState::pre_operational;
}

void NmtState::boot_up(BusTime time) {
  if (resets_ > 0) --resets_;
  booting_ = readdressed_ = moved_ = false;
  booted_at_ = time;
  commanded_.reset();
}

void NmtState::readdressed() {
  readdressed_ = true;
  commanded_.reset();
}

void NmtState::moved() {
  if (resets_ > 0) --resets_;
  booting_ = false;
  moved_ = readdressed_ = true;
  commanded_.reset();
}

void NmtState::reset_had_no_effect() {
  booting_ = false;
  resets_ = 0;
  commanded_.reset();
}

void NmtState::lose_track() {
  answers_with_ = 0;
  booting_ = false;
  commanded_.reset();
  ordered_at_.reset();
  booted_at_.reset();
  // A reset may be among what was lost, so that a boot-up message cannot be called unexpected.
  resets_ = 1;
}

}  // namespace conform::monitor
