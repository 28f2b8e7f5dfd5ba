// SPDX-License-Identifier: Apache-2.0
#include "time/producer.hpp"

namespace refnode {

namespace {

using std::chrono::milliseconds;

constexpr std::chrono::days day{1};

}  // namespace

TimeProducerRules::TimeProducerRules()
    : time_of_day([](milliseconds since_epoch) -> TimeOfDay {
        return {static_cast<std::uint32_t>((since_epoch % day).count()),
                static_cast<std::uint16_t>(since_epoch / day)};
      }) {}

// Some morning: without a clock that runs on while the power is off one time is as good as another.
TimeProducer::TimeProducer(Device& device, const CobIdRules& cob_id_rules)
    : device_(&device),
      cob_id_(device, cob_id_rules, 0x1012, 0, 0x00000100),
      set_to_(15000 * day + std::chrono::hours(8)) {}

void TimeProducer::bind() {
  if (Entry* cob_id = device_->dictionary.entry(0x1012, 0)) cob_id->written = [this] { update(); };
}

void TimeProducer::set_clock(TimeOfDay time) {
  if (!choices.goes_on_from_received) return;
  set_to_ = time.days * day + milliseconds(time.milliseconds);
  set_at_ = device_->now;
}

void TimeProducer::update() {
  if (!device_->works_now(Service::time) || !cob_id_.produced()) {
    raster_.stop();
  } else if (!raster_.runs()) {
    if (choices.begins_at) {
      set_to_ = set_to_ / day * day + *choices.begins_at;
      set_at_ = device_->now;
    }
    raster_.start(device_->now + (choices.first_at_once ? Duration::zero() : choices.period));
  }
}

void TimeProducer::on_time() {
  if (raster_.due(device_->now, choices.period)) transmit();
}

// Bits 27-0 milliseconds since midnight, 31-28 reserved, 47-32 days since 1984-01-01.
void TimeProducer::transmit() {
  const auto elapsed = std::chrono::duration_cast<milliseconds>(device_->now - set_at_);
  const TimeOfDay time = rules.time_of_day(set_to_ + elapsed);
  Bytes data = conform::to_le(time.milliseconds, 4);
  const Bytes days = conform::to_le(time.days, 2);
  data.insert(data.end(), days.begin(), days.end());
  device_->send(Service::time, conform::can::data_frame(conform::CanId(cob_id_.can_id()), data));
}

}  // namespace refnode
