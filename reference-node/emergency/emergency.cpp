// SPDX-License-Identifier: Apache-2.0
#include "emergency/emergency.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace refnode {

namespace {

// More unsent messages than this are not worth keeping; the oldest goes first.
constexpr std::size_t pending_limit = 32;

// Messages were lost, since too many waited.
constexpr ErrorCause overflow{0x1000, ErrorSource::application, 99};

// Error register, CiA 301 table 54: 0 generic, 1 current, 2 voltage, 3 temperature, 4 communication,
// 5 device profile, 6 reserved, 7 manufacturer.
std::uint8_t bits_of(std::uint16_t code) {
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

EmergencyRules::EmergencyRules()
    : register_bits(bits_of),
      inhibit_time([](std::int64_t value) -> Duration { return std::chrono::microseconds(value * 100); }),
      only_latest_of_stopped([] { return true; }),
      kept_waiting([](WhileWaiting occasion) {
        return occasion == WhileWaiting::state_change || occasion == WhileWaiting::inhibit_time_written;
      }),
      oldest_first([] { return true; }) {}

Emergency::Emergency(Device& device)
    : history(device), device_(&device), cob_id_(device, cob_id_rules, 0x1014, 0, 0x80U + device.node_id) {
  device.errors.raise = [this](const ErrorCause& cause, std::uint8_t detail) { raise(cause, detail); };
  device.errors.clear = [this](const ErrorCause& cause) { clear(cause); };
}

void Emergency::add_objects() {
  ObjectDictionary& od = device_->dictionary;
  od.add_variable(0x1001, integer_entry("Error register", DataType::unsigned8, Access::ro, 0)).tx_mappable =
      true;
  history.add_objects();
  od.add_variable(0x1014, cob_id_entry("COB-ID EMCY", Access::rw, 0x80, device_->node_id));
  od.add_variable(0x1015, integer_entry("Inhibit time EMCY", DataType::unsigned16, Access::rw, 0));
}

void Emergency::bind() {
  if (Entry* shown = device_->dictionary.entry(0x1001, 0))
    read_by(*shown, [this]() -> Upload { return Bytes{error_register()}; });
  history.bind();
  cob_id_.bind();
  if (Entry* inhibit = device_->dictionary.entry(0x1015, 0))
    inhibit->written = [this] {
      keep_or_drop(WhileWaiting::inhibit_time_written);
      begin_inhibiting();
    };
}

std::uint8_t Emergency::error_register() const {
  std::uint8_t bits = 0;
  for (const ErrorCause& cause : causes_) bits |= rules.register_bits(cause.code);
  if (choices.register_generic_only && bits != 0) bits = 0x01;
  return bits;
}

void Emergency::raise(const ErrorCause& cause, std::uint8_t detail) {
  if (std::ranges::find(causes_, cause) != causes_.end()) return;
  causes_.push_back(cause);
  record(cause.code, cause.source, detail);
  report({cause.code, error_register(), detail, cause.source});
}

void Emergency::clear(const ErrorCause& cause) {
  const auto found = std::ranges::find(causes_, cause);
  if (found == causes_.end()) return;
  causes_.erase(found);
  // With further causes left the standard allows a message, but asks for none.
  if (!causes_.empty() && !choices.error_reset_for_each) return;
  if (choices.error_resets_recorded) record(0, cause.source, 0);
  report({0, error_register(), 0, cause.source, device_->now + choices.error_reset_delay});
}

// What an EMCY will not tell of is not recorded, either.
void Emergency::record(std::uint16_t code, ErrorSource source, std::uint8_t detail) {
  if (full()) return;
  if (choices.only_signalled_recorded && !(cob_id_.valid() && device_->works_now(Service::emergency))) return;
  if (choices.completed_when_sent)
    history.record_incomplete(code);
  else
    history.record(code, source, detail);
}

bool Emergency::full() const {
  return choices.overflow_told_from != 0 && pending_.size() >= choices.overflow_told_from;
}

void Emergency::on_reset(bool whole_node) {
  std::erase_if(causes_, [&](const ErrorCause& cause) {
    // Nothing waits any more.
    return whole_node || cause.source != ErrorSource::application || cause == overflow;
  });
  history.clear();
  keep_or_drop(whole_node ? WhileWaiting::reset_node : WhileWaiting::reset_communication);
  inhibited_until_.reset();
  lost_ = false;
  reported_ = !causes_.empty();
}

void Emergency::on_state_change() {
  keep_or_drop(WhileWaiting::state_change);
  flush();
}

void Emergency::keep_or_drop(WhileWaiting occasion) {
  if (!rules.kept_waiting(occasion)) pending_.clear();
}

Duration Emergency::inhibit_time() const { return rules.inhibit_time(device_->time_value(0x1015, 0)); }

void Emergency::begin_inhibiting() {
  if (!choices.inhibited_from_setting) return;
  inhibited_until_.reset();
  if (inhibit_time() > Duration::zero()) inhibited_until_ = device_->now + inhibit_time();
  flush();  // what waited for the former inhibit time
}

void Emergency::report(const Message& message) {
  if (!cob_id_.valid()) return;
  if (device_->state == NmtState::stopped && !device_->works_now(Service::emergency)) {
    // An error reset only if the error had been reported.
    if (rules.only_latest_of_stopped()) {
      pending_.clear();
      if (message.code == 0 && !reported_) return;
    }
    if (choices.dropped_in_stopped) return;
  }
  if (choices.dropped_in_stopped && message.code == 0 && !reported_ && pending_.empty()) return;
  if (full()) {
    lost_ = true;
    return;
  }
  pending_.insert(rules.oldest_first() ? pending_.end() : pending_.begin(), message);
  if (pending_.size() > pending_limit) pending_.pop_front();
  flush();
}

void Emergency::flush() {
  if (!device_->works_now(Service::emergency)) return;
  // What waits when 1014h becomes not valid is not sent at all.
  if (!cob_id_.valid()) pending_.clear();
  while (!pending_.empty()) {
    if (const auto until = waits_until(); until && device_->now < *until) return;
    inhibited_until_.reset();
    Message message = pending_.front();
    pending_.pop_front();
    if (choices.completed_when_sent) {
      message.error_register = error_register();
      history.complete(message.code, message.source, message.detail);
    }
    transmit(message);
    reported_ = message.code != 0 || message.error_register != 0;
    if (inhibit_time() > Duration::zero()) inhibited_until_ = device_->now + inhibit_time();
    tell_of_overflow();
  }
}

void Emergency::tell_of_overflow() {
  if (lost_) {
    lost_ = false;
    raise(overflow, 0);
  } else if (pending_.empty()) {
    clear(overflow);
  }
}

// What the oldest message waits for. An error that follows ends the delay of an error reset.
std::optional<BusTime> Emergency::waits_until() const {
  if (pending_.size() != 1 || pending_.front().due <= device_->now) return inhibited_until_;
  return std::max(pending_.front().due, inhibited_until_.value_or(BusTime{}));
}

// Bytes 0-1 error code, 2 error register, 3-7 manufacturer: detail, source, zero.
void Emergency::transmit(const Message& message) {
  device_->send(
      Service::emergency,
      conform::can::data_frame(
          conform::CanId(cob_id_.can_id()),
          {static_cast<std::uint8_t>(message.code & 0xFFU), static_cast<std::uint8_t>(message.code >> 8U),
           message.error_register, message.detail, static_cast<std::uint8_t>(message.source), 0, 0, 0}));
}

void Emergency::on_time() {
  if (!pending_.empty()) flush();
}

std::optional<BusTime> Emergency::next_wakeup() const {
  if (pending_.empty() || !device_->works_now(Service::emergency)) return std::nullopt;
  return waits_until();
}

}  // namespace refnode
