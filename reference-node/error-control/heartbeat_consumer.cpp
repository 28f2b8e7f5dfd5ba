// SPDX-License-Identifier: Apache-2.0
#include "error-control/heartbeat_consumer.hpp"

namespace refnode {

namespace {

constexpr std::uint8_t monitored_nodes = 4;

ErrorCause lost(std::uint8_t sub) { return {0x8130, ErrorSource::heartbeat, sub}; }

}  // namespace

void HeartbeatConsumer::add_objects() {
  ObjectDictionary& od = device_->dictionary;
  od.add_complex(0x1016, "Consumer heartbeat time", ObjectKind::array);
  for (std::uint8_t sub = 1; sub <= monitored_nodes; ++sub)
    od.add_sub(0x1016, sub, integer_entry("Consumer heartbeat time", DataType::unsigned32, Access::rw, 0));
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

Accepted HeartbeatConsumer::check(std::uint8_t sub, ByteView bytes) const {
  const std::uint64_t wanted = conform::load_le(bytes);
  if ((wanted >> 24U) != 0 && !choices.reserved_bits_cleared) return refuse(choices.reserved_bits);
  const auto node = (wanted >> 16U) & 0xFFU;
  if (choices.no_node && (wanted & 0xFFFFU) != 0 && (node == 0 || node > 127))
    return refuse(*choices.no_node);
  if (!rules.used(wanted)) return {};
  // Two entries that are used must not name the same node.
  for (std::uint8_t other = 1; other <= entries(); ++other) {
    const std::uint64_t present = value_of(other);
    if (other != sub && rules.used(present) && monitored_node(present) == monitored_node(wanted))
      return refuse(choices.duplicate);
  }
  return {};
}

void HeartbeatConsumer::on_written(std::uint8_t sub) {
  Watch& watch = watches_[sub - 1U];
  if (choices.errors_end_together) {
    watch.due.reset();
    end_together();
  } else {
    if (watch.lost) device_->errors.clear(lost(sub));
    const auto due = watch.due;
    watch = {};
    if (!rules.ends_with_write(value_of(sub))) watch.due = due;
  }
  if (choices.reserved_bits_cleared) device_->dictionary.set_number(0x1016, sub, value_of(sub) & 0x00FFFFFFU);
}

void HeartbeatConsumer::on_reset() {
  if (rules.ends_with_reset()) watches_.assign(watches_.size(), {});
}

void HeartbeatConsumer::on_heartbeat(std::uint8_t node, std::uint8_t state) {
  for (std::uint8_t sub = 1; sub <= entries(); ++sub) {
    const std::uint64_t value = value_of(sub);
    if (!rules.used(value) || monitored_node(value) != node) continue;
    Watch& watch = watches_[sub - 1U];
    // What the boot-up of a monitored node means is left open.
    if (state == 0 && choices.boot_up != BootUpOfProducer::heartbeat) {
      if (watch.due && choices.boot_up == BootUpOfProducer::loss) lose(sub);
      watch.due.reset();
      continue;
    }
    watch.due = device_->now + rules.time(monitored_time(value));
    if (choices.errors_end_together) {
      end_together();
      continue;
    }
    if (!watch.lost) continue;
    watch.lost = false;
    device_->errors.clear(lost(sub));
  }
}

void HeartbeatConsumer::on_time() {
  for (std::uint8_t sub = 1; sub <= entries(); ++sub) {
    Watch& watch = watches_[sub - 1U];
    if (!watch.due || device_->now < *watch.due) continue;
    watch.due.reset();
    lose(sub);
  }
}

void HeartbeatConsumer::lose(std::uint8_t sub) {
  watches_[sub - 1U].lost = true;
  device_->errors.raise(lost(sub), monitored_node(value_of(sub)));
  if (on_loss) on_loss();
}

void HeartbeatConsumer::end_together() {
  for (std::uint8_t sub = 1; sub <= entries(); ++sub) {
    if (rules.used(value_of(sub)) && !watches_[sub - 1U].due) return;
  }
  for (std::uint8_t sub = 1; sub <= entries(); ++sub) {
    Watch& watch = watches_[sub - 1U];
    if (watch.lost) device_->errors.clear(lost(sub));
    watch.lost = false;
  }
}

std::optional<BusTime> HeartbeatConsumer::next_wakeup() const {
  std::optional<BusTime> first;
  for (const Watch& watch : watches_) keep_earlier(first, watch.due);
  return first;
}

}  // namespace refnode
