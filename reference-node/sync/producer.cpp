// SPDX-License-Identifier: Apache-2.0
#include "sync/producer.hpp"

#include <algorithm>
#include <chrono>

namespace refnode {

SyncProducerRules::SyncProducerRules()
    : period([](std::int64_t value) -> Duration { return std::chrono::microseconds(value); }),
      first_after([](Duration cycle) { return cycle; }),
      new_period([](Duration, Duration written) { return written; }),
      due_after_change([](BusTime, BusTime within_new_period) { return within_new_period; }),
      next_count([](std::uint8_t last, std::uint8_t overflow) -> std::uint8_t {
        return last >= overflow ? 1 : static_cast<std::uint8_t>(last + 1);
      }),
      counts_anew([](SyncStart) { return true; }) {}

SyncProducer::SyncProducer(Device& device, const CobIdRules& cob_id_rules)
    : device_(&device), cob_id_(device, cob_id_rules, 0x1005, 0, 0x00000080) {}

void SyncProducer::bind() {
  ObjectDictionary& od = device_->dictionary;
  if (Entry* cob_id = od.entry(0x1005, 0)) cob_id->written = [this] { update(SyncStart::bit_set); };
  if (Entry* period = od.entry(0x1006, 0)) {
    period->check = [this](ByteView bytes) { return check_period(bytes); };
    period->written = [this] { update(SyncStart::period_set); };
  }
}

Accepted SyncProducer::check_period(ByteView bytes) const {
  const std::uint64_t period = conform::load_le(bytes);
  if (period == 0 || period == device_->dictionary.number(0x1006, 0)) return {};
  if (period < choices.shortest) return refuse(choices.too_short);
  if (period > choices.longest) return refuse(choices.too_long);
  if (period % choices.resolution != 0) return refuse(choices.not_a_multiple);
  return {};
}

void SyncProducer::update(SyncStart occasion) {
  const Duration period = rules.period(device_->time_value(0x1006, 0));
  if (!device_->works_now(Service::sync) || !cob_id_.produced() || period <= Duration::zero()) {
    raster_.stop();
    return;
  }
  if (raster_.runs()) return set_period(period);
  if (rules.counts_anew(occasion)) count_ = 0;
  period_ = period;
  raster_.start(device_->now + (choices.first_at_once ? Duration::zero() : rules.first_after(period_)));
}

// Whoever writes 1005h again, or the period that there is, does not disturb the cycle.
void SyncProducer::set_period(Duration written) {
  const Duration period = rules.new_period(period_, written);
  if (period == period_) return;
  period_ = period;
  const BusTime first = device_->now + period_;
  const BusTime due = raster_.next().value_or(first);
  raster_.start(choices.due_sync_stays ? std::min(due, first) : rules.due_after_change(due, first));
}

void SyncProducer::on_reset() {
  raster_.stop();
  count_ = 0;
}

void SyncProducer::on_boot_up() { update(SyncStart::boot_up); }

void SyncProducer::on_state_change(NmtState from) {
  update(from == NmtState::stopped ? SyncStart::left_stopped : SyncStart::boot_up);
}

void SyncProducer::on_time() {
  if (raster_.due(device_->now, period_, choices.jitter_percent)) transmit();
}

// Without data, or with the counter in one byte.
void SyncProducer::transmit() {
  const auto overflow = static_cast<std::uint8_t>(device_->dictionary.number(0x1019, 0));
  Bytes data;
  if (overflow > 1) {
    count_ = rules.next_count(count_, overflow);
    data.push_back(count_);
  }
  device_->send(Service::sync, conform::can::data_frame(conform::CanId(cob_id_.can_id()), data));
  if (on_sync) on_sync(data.empty() ? std::nullopt : std::optional(data.front()));
}

}  // namespace refnode
