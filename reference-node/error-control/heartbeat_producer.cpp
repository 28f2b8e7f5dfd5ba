// SPDX-License-Identifier: Apache-2.0
#include "error-control/heartbeat_producer.hpp"

#include <algorithm>

namespace refnode {

void HeartbeatProducer::add_objects() {
  device_->dictionary.add_variable(
      0x1017, integer_entry("Producer heartbeat time", DataType::unsigned16, Access::rw, 0));
}

void HeartbeatProducer::bind() {
  if (Entry* period = device_->dictionary.entry(0x1017, 0)) period->written = [this] { on_written(); };
}

void HeartbeatProducer::start() {
  raster_.stop();
  period_ = rules.period(device_->time_value(0x1017, 0));
  if (period_ == Duration::zero()) return;
  raster_.start(device_->now + period_);
  if (choices.at_once) transmit();
}

void HeartbeatProducer::on_written() {
  start();
  if (choices.from_last && raster_.runs()) raster_.start(std::max(sent_ + period_, device_->now));
}

void HeartbeatProducer::on_reset() {
  // The next one, some time early; where one has just been sent, none waits behind it.
  if (choices.crosses_reset && raster_.runs() && device_->now - sent_ >= period_ / 2)
    device_->send(Service::heartbeat, waiting_);
  raster_.stop();
}

void HeartbeatProducer::on_boot_up() {
  waiting_ = message();
  sent_ = device_->now;
  start();
  if (choices.first_early && raster_.runs()) raster_.start(device_->now + period_ / 2);
}

void HeartbeatProducer::on_state_change() {
  waiting_ = message();
  if (!choices.at_state_change || !raster_.runs()) return;
  transmit();
  if (choices.restarts_at_change) raster_.start(device_->now + period_);
}

void HeartbeatProducer::on_time() {
  if (raster_.due(device_->now, period_, choices.jitter_percent)) transmit();
}

void HeartbeatProducer::transmit() {
  sent_ = device_->now;
  device_->send(Service::heartbeat, message());
}

// One byte: the NMT state; bit 7 is reserved.
conform::can::Frame HeartbeatProducer::message() const {
  return conform::can::data_frame(conform::CanId(0x700U + device_->node_id),
                                  {static_cast<std::uint8_t>(device_->state)});
}

}  // namespace refnode
