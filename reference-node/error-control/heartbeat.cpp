// SPDX-License-Identifier: Apache-2.0
#include "error-control/heartbeat.hpp"

namespace refnode {

using std::chrono::milliseconds;

void HeartbeatProducer::bind() {
  if (Entry* period = device_->dictionary.entry(0x1017, 0)) period->written = [this] { on_period_written(); };
}

Duration HeartbeatProducer::period() const {
  return milliseconds(device_->time_value(0x1017, 0) * device_->behaviour.heartbeat_period_factor);
}

void HeartbeatProducer::on_boot_up() {
  next_.reset();
  if (period() > Duration::zero() && !device_->behaviour.heartbeat_not_started_at_boot) {
    next_ = device_->now + period();
    if (device_->choices.heartbeat_at_once) transmit();
  }
}

void HeartbeatProducer::on_period_written() {
  const Behaviour& behaviour = device_->behaviour;
  if (behaviour.heartbeat_starts_only_after_reset) return;
  if (behaviour.heartbeat_zero_does_not_stop && period() == Duration::zero()) return;
  next_.reset();
  if (period() == Duration::zero()) return;
  next_ = device_->now + period();
  ends_.reset();
  if (behaviour.heartbeat_ends_after_ms > 0)
    ends_ = device_->now + milliseconds(behaviour.heartbeat_ends_after_ms);
  if (device_->choices.heartbeat_at_once) transmit();
}

void HeartbeatProducer::on_state_change() {
  const bool off = period() == Duration::zero();
  if (off ? device_->behaviour.heartbeat_on_state_change_when_off
          : device_->choices.heartbeat_at_state_change)
    transmit();
}

void HeartbeatProducer::on_time() {
  if (!next_ || device_->now < *next_) return;
  if (ends_ && device_->now >= *ends_) return next_.reset();
  Duration step = period() > Duration::zero() ? period() : Duration(milliseconds(100));
  if (const int percent = device_->choices.heartbeat_jitter_percent; percent != 0) {
    late_ = !late_;
    step += (late_ ? step : -step) * percent / 100;
  }
  // The raster is kept; only after a stall of more than a period it starts anew instead of catching up.
  next_ = *next_ + step;
  if (*next_ <= device_->now) next_ = device_->now + step;
  if (device_->behaviour.heartbeat_stops_in_stopped && device_->state == NmtState::stopped) return;
  transmit();
}

void HeartbeatProducer::transmit() {
  const Behaviour& behaviour = device_->behaviour;
  auto state = static_cast<std::uint8_t>(device_->state);
  if (behaviour.heartbeat_state_stale) state = static_cast<std::uint8_t>(NmtState::pre_operational);
  if (behaviour.heartbeat_with_toggle_bit && toggle_) state |= 0x80U;
  toggle_ = !toggle_;
  device_->send(Service::heartbeat,
                conform::can::data_frame(conform::CanId(0x700U + device_->node_id), {state}));
}

void HeartbeatConsumer::bind() {
  const auto object = device_->dictionary.objects().find(0x1016);
  if (object == device_->dictionary.objects().end()) return;
  for (auto& [sub, entry] : object->second.entries) {
    if (sub == 0 || sub == 0xFF) continue;
    watches_.resize(sub);
    entry.check = [this, which = sub](ByteView bytes) { return check(which, bytes); };
    entry.written = [this, which = sub] { on_written(which); };
  }
}

// 1016h: bits 31-24 reserved, 23-16 node-ID, 15-0 heartbeat time in ms.
std::uint8_t HeartbeatConsumer::node_of(std::uint64_t value) const {
  return static_cast<std::uint8_t>((value >> 16U) & 0xFFU);
}

Duration HeartbeatConsumer::time_of(std::uint64_t value) const {
  return milliseconds(static_cast<std::int64_t>(value & 0xFFFFU) * device_->behaviour.consumer_time_factor);
}

bool HeartbeatConsumer::monitored(std::uint64_t value) const {
  if (device_->behaviour.consumer_zero_time_monitored && node_of(value) != 0) return true;
  return (value & 0xFFFFU) != 0 && node_of(value) >= 1 && node_of(value) <= 127;
}

Accepted HeartbeatConsumer::check(std::uint8_t sub, ByteView bytes) const {
  const std::uint64_t value = conform::load_le(bytes);
  const Behaviour& behaviour = device_->behaviour;
  const Choices& choices = device_->choices;
  if ((value >> 24U) != 0 && !behaviour.consumer_accepts_reserved_bits &&
      !choices.consumer_reserved_bits_cleared)
    return refuse(choices.consumer_reserved_bits);
  const bool counts = monitored(value) || (behaviour.consumer_zero_time_is_duplicate && node_of(value) != 0);
  if (!counts || behaviour.consumer_accepts_duplicate) return {};
  for (std::uint8_t other = 1; other <= entries(); ++other) {
    if (other == sub && !behaviour.consumer_own_entry_is_duplicate) continue;
    const std::uint64_t present = value_of(other);
    if (monitored(present) && node_of(present) == node_of(value)) {
      return refuse(choices.duplicate_consumer);
    }
  }
  return {};
}

void HeartbeatConsumer::on_written(std::uint8_t sub) {
  Watch& watch = watches_[sub - 1U];
  if (watch.lost) device_->errors.clear({0x8130, ErrorSource::heartbeat, sub});
  watch = {};
  if (device_->choices.consumer_reserved_bits_cleared)
    device_->dictionary.set_number(0x1016, sub, value_of(sub) & 0x00FFFFFFU);
  if (device_->behaviour.consumer_starts_without_heartbeat && monitored(value_of(sub))) {
    watch.due = device_->now + time_of(value_of(sub));
  }
}

void HeartbeatConsumer::on_reset() { watches_.assign(watches_.size(), {}); }

void HeartbeatConsumer::on_heartbeat(std::uint8_t node, std::uint8_t state) {
  for (std::uint8_t sub = 1; sub <= entries(); ++sub) {
    const std::uint64_t value = value_of(sub);
    if (!monitored(value) || (sub > 1 && device_->behaviour.consumer_only_first_entry)) continue;
    if (node_of(value) != node && !device_->behaviour.consumer_node_id_unchecked) continue;
    Watch& watch = watches_[sub - 1U];
    if (watch.due && device_->behaviour.consumer_timer_not_restarted) continue;
    // What the boot-up of a monitored node means is left open.
    if (state == 0 && device_->choices.boot_up_of_producer != BootUpOfProducer::heartbeat) {
      if (watch.due && device_->choices.boot_up_of_producer == BootUpOfProducer::loss) lose(sub);
      watch.due.reset();
      continue;
    }
    watch.due = device_->now + time_of(value);
    if (!watch.lost) continue;
    watch.lost = false;
    if (!device_->behaviour.consumer_error_never_resolved) {
      device_->errors.clear({0x8130, ErrorSource::heartbeat, sub});
    }
  }
}

void HeartbeatConsumer::on_time() {
  for (std::uint8_t sub = 1; sub <= entries(); ++sub) {
    Watch& watch = watches_[sub - 1U];
    if (!watch.due || device_->now < *watch.due) continue;
    watch.due.reset();
    if (!device_->behaviour.consumer_loss_not_detected) lose(sub);
  }
}

void HeartbeatConsumer::lose(std::uint8_t sub) {
  watches_[sub - 1U].lost = true;
  const auto code = static_cast<std::uint16_t>(device_->behaviour.consumer_wrong_code ? 0x1000 : 0x8130);
  device_->errors.raise({code, ErrorSource::heartbeat, sub}, node_of(value_of(sub)));
  if (on_loss) on_loss();
}

std::optional<BusTime> HeartbeatConsumer::next_wakeup() const {
  std::optional<BusTime> first;
  for (const Watch& watch : watches_) first = earliest({first, watch.due});
  return first;
}

}  // namespace refnode
