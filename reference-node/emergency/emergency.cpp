// SPDX-License-Identifier: Apache-2.0
#include "emergency/emergency.hpp"

#include <algorithm>
#include <iterator>

namespace refnode {

namespace {

// More unsent messages than this are not worth keeping; the oldest goes first.
constexpr std::size_t pending_limit = 32;

// Error register, CiA 301 table 54: 0 generic, 1 current, 2 voltage, 3 temperature, 4 communication,
// 5 device profile, 6 reserved, 7 manufacturer.
std::uint8_t register_bits(std::uint16_t code) {
  switch (code >> 12U) {
    case 0x2: return 0x03;
    case 0x3: return 0x05;
    case 0x4: return 0x09;
    default: break;
  }
  switch (code >> 8U) {
    case 0x81:
    case 0x82: return 0x11;
    case 0xFF: return 0x81;
    default: return 0x01;
  }
}

}  // namespace

Emergency::Emergency(Device& device)
    : device_(&device), cob_id_(device, CobIdUse::emergency, 0x1014, 0, 0x80U + device.node_id) {}

void Emergency::add_objects() {
  ObjectDictionary& od = device_->dictionary;
  od.add_variable(0x1001, integer_entry("Error register", DataType::unsigned8, Access::ro, 0)).tx_mappable =
      true;
  od.add_complex(0x1003, "Pre-defined error field", ObjectKind::array);
  for (std::uint8_t sub = 1; sub <= history_depth; ++sub)
    od.add_sub(0x1003, sub, integer_entry("Standard error field", DataType::unsigned32, Access::ro, 0));
  // Sub-index 00h of this array is the number of recorded errors and can be written to clear them.
  od.add_sub(0x1003, 0, integer_entry("Number of errors", DataType::unsigned8, Access::rw, 0));
  od.add_variable(0x1014,
                  integer_entry("COB-ID EMCY", DataType::unsigned32, Access::rw, 0x80U + device_->node_id));
  od.add_variable(0x1015, integer_entry("Inhibit time EMCY", DataType::unsigned16, Access::rw, 0));
}

void Emergency::bind() {
  ObjectDictionary& od = device_->dictionary;
  if (Entry* shown = od.entry(0x1001, 0))
    read_by(*shown, [this]() -> Upload { return Bytes{error_register()}; });
  if (const auto history = od.objects().find(0x1003); history != od.objects().end()) {
    for (auto& [sub, field] : history->second.entries) {
      if (sub != 0 && sub != 0xFF) read_by(field, [this, place = sub] { return read_history(place); });
    }
  }
  if (Entry* count = od.entry(0x1003, 0)) {
    count->command = true;
    count->low.reset();  // of the numbers it shows, not of the 00h that can be written
    count->high.reset();
    read_by(*count, [this]() -> Upload { return Bytes{recorded()}; });
    count->check = [this](ByteView bytes) { return write_history_count(bytes); };
  }
  cob_id_.bind();
}

bool Emergency::known_class(std::uint16_t code) {
  constexpr std::uint8_t classes[] = {0x10, 0x20, 0x21, 0x22, 0x23, 0x30, 0x31, 0x32, 0x33, 0x40, 0x41, 0x42,
                                      0x50, 0x60, 0x61, 0x62, 0x63, 0x70, 0x80, 0x81, 0x82, 0x90, 0xF0, 0xFF};
  return std::find(std::begin(classes), std::end(classes), code >> 8U) != std::end(classes);
}

std::uint8_t Emergency::error_register() const {
  std::uint8_t bits = 0;
  for (const ErrorCause& cause : causes_) bits |= register_bits(cause.code);
  const Behaviour& behaviour = device_->behaviour;
  if (behaviour.error_register_never_set) return 0;
  if (behaviour.error_register_without_generic) bits &= 0xFEU;
  if (behaviour.error_register_bit6_set && bits != 0) bits |= 0x40U;
  if (behaviour.communication_bit_missing) bits &= static_cast<std::uint8_t>(~0x10U);
  if (device_->choices.register_generic_only && bits != 0) bits = 0x01;
  if (bits == 0 && behaviour.error_register_sticks && raised_) bits = 0x01;
  return bits;
}

void Emergency::raise(const ErrorCause& cause, std::uint8_t detail) {
  if (std::find(causes_.begin(), causes_.end(), cause) != causes_.end()) return;
  const bool others = !causes_.empty();
  causes_.push_back(cause);
  raised_ = true;
  record(cause.code, cause.source, detail);
  if (others && device_->behaviour.second_error_suppressed) return;
  report({cause.code, error_register(), detail, cause.source});
}

void Emergency::clear(const ErrorCause& cause) {
  if (device_->behaviour.errors_never_clear) return;
  const auto found = std::find(causes_.begin(), causes_.end(), cause);
  if (found == causes_.end()) return;
  causes_.erase(found);
  // With further causes left the standard allows a message, but asks for none.
  if (!causes_.empty()) {
    if (device_->behaviour.error_reset_too_early) report({0, 0, 0, cause.source});
    if (device_->choices.error_reset_for_each) report({0, error_register(), 0, cause.source});
    return;
  }
  if (device_->behaviour.records_error_reset) record(0, cause.source, 0);
  if (!device_->behaviour.error_reset_not_sent) report({0, error_register(), 0, cause.source});
}

void Emergency::clear_all(std::optional<std::uint8_t> source) {
  const std::vector<ErrorCause> causes = causes_;
  for (const ErrorCause& cause : causes) {
    if (!source || cause.source == *source) clear(cause);
  }
}

void Emergency::record(std::uint16_t code, std::uint8_t source, std::uint8_t detail) {
  const Behaviour& behaviour = device_->behaviour;
  if (behaviour.history_not_written) return;
  // Bits 15-0 error code, bits 31-16 manufacturer: detail and source.
  std::uint32_t field =
      code | (static_cast<std::uint32_t>(detail) << 16U) | (static_cast<std::uint32_t>(source) << 24U);
  if (behaviour.history_code_in_upper_half) field = static_cast<std::uint32_t>(code) << 16U;
  if (behaviour.history_code_byte_swapped) field = ((code & 0xFFU) << 8U) | (code >> 8U);
  if (behaviour.history_overwrites) history_.clear();
  const std::size_t depth = device_->choices.history_depth;
  if (behaviour.history_full_drops_newest && history_.size() == depth) return;
  if (behaviour.history_oldest_first) {
    history_.push_back(field);
    if (history_.size() > depth) history_.pop_front();
    return;
  }
  history_.push_front(field);
  if (history_.size() > depth && !behaviour.history_count_exceeds_depth) history_.pop_back();
}

std::uint8_t Emergency::recorded() const {
  if (device_->behaviour.history_count_not_updated) return 0;
  return static_cast<std::uint8_t>(std::min<std::size_t>(history_.size(), 0xFE));
}

Upload Emergency::read_history(std::uint8_t sub) const {
  if (sub > history_.size()) {
    if (device_->behaviour.history_empty_reads_zero) return Bytes(4, 0);
    return refuse(sub == 1 ? device_->choices.nothing_recorded : device_->choices.history_unused_field);
  }
  return conform::to_le(history_[sub - 1U], 4);
}

Accepted Emergency::write_history_count(ByteView bytes) {
  const Behaviour& behaviour = device_->behaviour;
  if (conform::load_le(bytes) != 0) {
    if (behaviour.history_nonzero_write_clears) history_.clear();
    if (!behaviour.history_nonzero_write_accepted) return refuse(abort_code::invalid_value);
    return {};
  }
  if (behaviour.history_clear_rejected) return refuse(abort_code::general_error);
  if (behaviour.history_clear_ignored) return {};
  history_.clear();
  if (behaviour.history_clear_resets_errors) clear_all(std::nullopt);
  return {};
}

void Emergency::on_reset(bool whole_node) {
  std::erase_if(causes_,
                [&](const ErrorCause& cause) { return whole_node || cause.source != application_source; });
  if (whole_node) raised_ = false;
  history_.clear();
  if (device_->behaviour.history_starts_with_error) history_.push_back(0x00001000);
  pending_.clear();
  inhibited_until_.reset();
  reported_ = !causes_.empty();
}

Duration Emergency::inhibit_time() const {
  // 1015h counts in 100 us.
  return std::chrono::microseconds(device_->time_value(0x1015, 0) *
                                   device_->behaviour.emergency_inhibit_unit_us);
}

void Emergency::report(const Message& message) {
  if (!cob_id_.valid() && !device_->behaviour.emergency_sent_when_not_valid) return;
  if (device_->state == NmtState::stopped && !device_->behaviour.emergency_sent_in_stopped) {
    // Only the latest is of interest afterwards, and an error reset only if the error had been reported.
    pending_.clear();
    if (message.code == 0 && !reported_) return;
    if (device_->choices.emergency_dropped_in_stopped) return;
  }
  if (device_->choices.emergency_dropped_in_stopped && message.code == 0 && !reported_ && pending_.empty())
    return;
  const bool waits = inhibited_until_ && device_->now < *inhibited_until_;
  if (waits && device_->behaviour.emergency_lost_while_inhibited) return;
  pending_.push_back(message);
  if (pending_.size() > pending_limit) pending_.pop_front();
  flush();
}

void Emergency::flush() {
  const bool silent_state =
      device_->state == NmtState::initialising ||
      (device_->state == NmtState::stopped && !device_->behaviour.emergency_sent_in_stopped);
  if (silent_state) return;
  while (!pending_.empty()) {
    if (inhibited_until_ && device_->now < *inhibited_until_) return;
    inhibited_until_.reset();
    const Message message = pending_.front();
    pending_.pop_front();
    transmit(message);
    reported_ = message.code != 0;
    if (inhibit_time() > Duration::zero()) inhibited_until_ = device_->now + inhibit_time();
  }
}

void Emergency::transmit(const Message& message) {
  const Behaviour& behaviour = device_->behaviour;
  // Bytes 0-1 error code, 2 error register, 3-7 manufacturer: detail, source, zero.
  const std::uint8_t shown = behaviour.emergency_register_always_generic && message.code != 0
                                 ? std::uint8_t{0x01}
                                 : message.error_register;
  device_->send(Service::emergency,
                conform::can::data_frame(conform::CanId(cob_id_.can_id()),
                                         {static_cast<std::uint8_t>(message.code & 0xFFU),
                                          static_cast<std::uint8_t>(message.code >> 8U), shown,
                                          message.detail, message.source, 0, 0, 0}));
}

void Emergency::on_state_change() { flush(); }

void Emergency::on_time() {
  if (inhibited_until_ && device_->now >= *inhibited_until_) flush();
}

std::optional<BusTime> Emergency::next_wakeup() const {
  if (pending_.empty() || device_->state == NmtState::stopped || device_->state == NmtState::initialising) {
    return std::nullopt;
  }
  return inhibited_until_;
}

}  // namespace refnode
