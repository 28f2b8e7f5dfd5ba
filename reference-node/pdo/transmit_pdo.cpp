// SPDX-License-Identifier: Apache-2.0
#include "pdo/transmit_pdo.hpp"

#include "pdo/bits.hpp"

namespace refnode {

TransmitPdoRules::TransmitPdoRules()
    : valid([](const PdoParameters& parameters) { return parameters.cob_id().valid(); }),
      sent_at_sync([](std::uint8_t type, std::uint32_t syncs, bool event) {
        return type == 0 ? event : is_synchronous(type) && syncs >= type;
      }),
      has_event_timer(is_event_driven) {}

TransmitPdo::TransmitPdo(Device& device, const TransmitPdoTerms& terms, std::uint16_t number)
    : device_(&device), terms_(&terms), parameters_(device, terms.parameters, number) {
  parameters_.on_changed = [this] { restart(); };
}

bool TransmitPdo::enabled() const {
  const bool something = parameters_.mapped_size() > 0 || terms_->choices.sent_empty;
  return device_->works_now(Service::tpdo) && terms_->rules.valid(parameters_) && something;
}

bool TransmitPdo::timed() const {
  return terms_->rules.has_event_timer(parameters_.transmission_type()) &&
         parameters_.event_timer() > Duration::zero();
}

Bytes TransmitPdo::content() const {
  Bytes data;
  std::size_t position = 0;  // in bits
  for (const Mapped& mapped : parameters_.mapping()) {
    const Upload value =
        device_->dictionary.upload({conform::Index(mapped.index), conform::SubIndex(mapped.sub)});
    Bytes part = value.value_or(Bytes{});
    part.resize(whole_bytes(mapped.bits));
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
  if (timed() && enabled()) timer_ = device_->now + parameters_.event_timer();
}

void TransmitPdo::on_application_change() {
  if (!terms_->choices.change_is_event || !enabled() || content() == reported_) return;
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
  if (type == remote_synchronous_type) sampled_ = content();
  ++syncs_;
  if (terms_->rules.sent_at_sync(type, syncs_, event_)) transmit(content());
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
  if (!terms_->choices.initial_event || !enabled()) return;
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
  if (terms_->choices.sends_at_first_sync && type >= 1 && is_synchronous(type)) syncs_ = type - 1U;
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
  if (!timed()) return;
  if (inhibited_until_) {
    event_ = true;
  } else {
    transmit(content());
  }
}

std::optional<BusTime> TransmitPdo::next_wakeup() const { return earliest({timer_, inhibited_until_}); }

}  // namespace refnode
