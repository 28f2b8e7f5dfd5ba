// SPDX-License-Identifier: Apache-2.0
#include "pdo/pdo.hpp"

#include <algorithm>

namespace refnode {

namespace {

constexpr std::uint8_t last_synchronous_type = 0xF0;
constexpr std::uint8_t remote_synchronous_type = 0xFC;

std::size_t whole_bytes(std::size_t bits) { return (bits + 7) / 8; }

/// Bits of a PDO are numbered as they are sent: the least significant of the first byte comes first (CiA
/// 301, 7.1.4).
void copy_bits(ByteView from, std::size_t first, Bytes& to, std::size_t target, std::size_t count) {
  for (std::size_t bit = 0; bit < count; ++bit) {
    const unsigned value = (from[(first + bit) / 8] >> ((first + bit) % 8)) & 1U;
    auto& byte = to[(target + bit) / 8];
    byte = static_cast<std::uint8_t>(byte | (value << ((target + bit) % 8)));
  }
}

}  // namespace

ReceivePdo::ReceivePdo(Device& device, const CobIdRules& cob_id_rules, std::uint16_t number)
    : device_(&device), number_(number), parameters_(device, cob_id_rules, PdoDirection::receive, number) {}

bool ReceivePdo::on_frame(const Frame& frame) {
  const Behaviour& behaviour = device_->behaviour;
  if (!parameters_.cob_id().valid() || frame.id != parameters_.cob_id().can_id()) return false;
  if (device_->state != NmtState::operational && !behaviour.rpdo_processed_in_pre_operational) return true;
  const std::size_t size = parameters_.mapped_size();
  if (size == 0) return true;
  const ErrorCause too_short = cause(0x8210);
  if (frame.size() < size) {
    if (!behaviour.short_rpdo_not_reported) device_->errors.raise(too_short, frame.size());
    if (!behaviour.short_rpdo_processed) return true;
  } else {
    device_->errors.clear(too_short);
  }
  if (frame.size() > size && behaviour.long_rpdo_dropped) return true;
  const ErrorCause too_long = cause(0x8220);
  if (frame.size() <= size) {
    device_->errors.clear(too_long);
  } else if (device_->choices.long_rpdo_reported) {
    device_->errors.raise(too_long, frame.size());
  }

  const Duration limit = parameters_.event_timer();
  deadline_.reset();
  if (limit > Duration::zero()) deadline_ = device_->now + limit;
  device_->errors.clear(cause(0x8250));

  Bytes data(frame.data.begin(), frame.data.begin() + static_cast<std::ptrdiff_t>(size));
  const bool synchronous = parameters_.transmission_type() <= last_synchronous_type;
  if (synchronous && !behaviour.sync_rpdo_applied_at_once) {
    buffered_ = std::move(data);
  } else {
    apply(data);
  }
  return true;
}

void ReceivePdo::on_sync() {
  const bool works =
      device_->state == NmtState::operational || device_->behaviour.rpdo_processed_in_pre_operational;
  if (buffered_ && works) apply(*buffered_);
  buffered_.reset();
}

void ReceivePdo::on_state_change() {
  buffered_.reset();
  deadline_.reset();
}

void ReceivePdo::on_time() {
  if (!deadline_ || device_->now < *deadline_) return;
  deadline_.reset();
  device_->errors.raise(cause(0x8250), 0);
}

void ReceivePdo::apply(const Bytes& data) {
  if (device_->behaviour.rpdo_data_ignored) return;
  applying_ = true;
  std::size_t position = 0;  // in bits
  for (const auto& mapped : parameters_.mapping()) {
    if (position + mapped.bits > data.size() * 8) break;
    Entry* entry = device_->dictionary.entry(mapped.index, mapped.sub);  // none: a placeholder
    if (entry != nullptr && entry->value.size() == whole_bytes(mapped.bits)) {
      entry->value.assign(entry->value.size(), 0);
      copy_bits(data, position, entry->value, 0, mapped.bits);
      if (device_->behaviour.rpdo_data_big_endian) std::reverse(entry->value.begin(), entry->value.end());
      if (entry->written) entry->written();
    }
    position += mapped.bits;
  }
  applying_ = false;
  if (on_applied) on_applied();
}

TransmitPdo::TransmitPdo(Device& device, const CobIdRules& cob_id_rules, std::uint16_t number)
    : device_(&device), parameters_(device, cob_id_rules, PdoDirection::transmit, number) {
  parameters_.on_changed = [this] { restart(); };
}

bool TransmitPdo::enabled() const {
  const bool state =
      device_->state == NmtState::operational ||
      (device_->state == NmtState::pre_operational && device_->behaviour.tpdo_sent_in_pre_operational);
  const bool timed = device_->behaviour.tpdo_timer_ignores_valid_bit && event_driven() &&
                     parameters_.event_timer() > Duration::zero();
  const bool something = parameters_.mapped_size() > 0 || device_->choices.tpdo.sent_empty;
  return state && (parameters_.cob_id().valid() || timed) && something;
}

Bytes TransmitPdo::content() const {
  Bytes data;
  std::size_t position = 0;  // in bits
  for (const auto& mapped : parameters_.mapping()) {
    const Upload value =
        device_->dictionary.upload({conform::Index(mapped.index), conform::SubIndex(mapped.sub)});
    Bytes part = value.value_or(Bytes{});
    part.resize(whole_bytes(mapped.bits));
    if (device_->behaviour.tpdo_data_big_endian) std::reverse(part.begin(), part.end());
    data.resize(whole_bytes(position + mapped.bits));
    copy_bits(part, 0, data, position, mapped.bits);
    position += mapped.bits;
  }
  if (data.size() > 8) data.resize(8);
  return data;
}

void TransmitPdo::transmit(const Bytes& data) {
  if (!enabled()) return;
  device_->send(Service::tpdo, conform::can::data_frame(conform::CanId(parameters_.cob_id().can_id()), data));
  reported_ = data;
  event_ = false;
  syncs_ = 0;
  inhibited_until_.reset();
  if (event_driven() && parameters_.inhibit_time() > Duration::zero()) {
    inhibited_until_ = device_->now + parameters_.inhibit_time();
  }
  start_event_timer();
}

void TransmitPdo::start_event_timer() {
  timer_.reset();
  const bool applies = event_driven() || device_->behaviour.event_timer_in_synchronous_types;
  if (applies && enabled() && parameters_.event_timer() > Duration::zero()) {
    timer_ = device_->now + parameters_.event_timer();
  }
}

void TransmitPdo::on_application_change() {
  if (!enabled() || content() == reported_) return;
  if (device_->behaviour.tpdo_change_ignored || !device_->choices.tpdo.change_is_event) return;
  event_ = true;
  if (!event_driven()) return;
  if (inhibited_until_ && device_->now < *inhibited_until_) return;
  transmit(content());
}

void TransmitPdo::on_sync(std::optional<std::uint8_t> counter) {
  if (!enabled()) return;
  // Counting begins at the SYNC that has the start value; where SYNCs are not counted it means nothing.
  if (awaits_start_ && counter) {
    if (*counter != parameters_.sync_start()) return;
    awaits_start_ = false;
  }
  const std::uint8_t type = parameters_.transmission_type();
  if (type == remote_synchronous_type) {
    sampled_ = content();
    if (device_->behaviour.remote_type_sends_at_sync) transmit(sampled_);
  } else if (type == 0) {
    if (event_ || device_->behaviour.acyclic_type_sends_every_sync) transmit(content());
  } else if (type <= last_synchronous_type) {
    const std::uint32_t ratio = type + (device_->behaviour.sync_ratio_off_by_one ? 1U : 0U);
    if (++syncs_ >= ratio) transmit(content());
  }
}

bool TransmitPdo::on_remote(const Frame& frame) {
  if (!enabled() || frame.id != parameters_.cob_id().can_id()) return false;
  if (!parameters_.cob_id().remote_allowed()) return true;
  const bool sampled = parameters_.transmission_type() == remote_synchronous_type && !sampled_.empty();
  transmit(sampled ? sampled_ : content());
  return true;
}

void TransmitPdo::on_state_change() {
  restart();
  if (!device_->choices.tpdo.initial_event || !enabled()) return;
  event_ = true;
  if (event_driven()) transmit(content());
}

void TransmitPdo::restart() {
  event_ = false;
  syncs_ = 0;
  sampled_.clear();
  awaits_start_ = parameters_.sync_start() != 0;
  inhibited_until_.reset();
  timer_.reset();
  if (!enabled()) return;
  const std::uint8_t type = parameters_.transmission_type();
  const bool first = device_->choices.tpdo.sends_at_first_sync && type >= 1 && type <= last_synchronous_type;
  if (first) syncs_ = type - 1U;
  reported_ = content();
  start_event_timer();
}

void TransmitPdo::on_time() {
  if (inhibited_until_ && device_->now >= *inhibited_until_) {
    inhibited_until_.reset();
    if (event_ && event_driven()) transmit(content());
  }
  if (!timer_ || device_->now < *timer_) return;
  timer_.reset();
  const bool applies = event_driven() || device_->behaviour.event_timer_in_synchronous_types;
  if (!applies || parameters_.event_timer() == Duration::zero()) return;
  if (inhibited_until_) {
    event_ = true;
  } else {
    transmit(content());
  }
}

std::optional<BusTime> TransmitPdo::next_wakeup() const { return earliest({timer_, inhibited_until_}); }

}  // namespace refnode
