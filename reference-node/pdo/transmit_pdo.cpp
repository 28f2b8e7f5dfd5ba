// SPDX-License-Identifier: Apache-2.0
#include "pdo/transmit_pdo.hpp"

#include <algorithm>
#include <utility>

#include "pdo/bits.hpp"

namespace refnode {

TransmitPdoRules::TransmitPdoRules()
    : valid([](const PdoParameters& parameters) { return parameters.cob_id().valid(); }),
      sent_at_sync([](const PdoParameters& pdo, std::uint32_t syncs, bool event) {
        const std::uint8_t type = pdo.transmission_type();
        return type == 0 ? event : is_synchronous(type) && syncs >= type;
      }),
      counting_begins([](const PdoParameters& pdo, std::optional<std::uint8_t> counter) {
        return !counter || *counter == pdo.sync_start();
      }),
      sent_with_event([](const PdoParameters& pdo) { return is_event_driven(pdo.transmission_type()); }),
      has_event_timer([](const PdoParameters& pdo) { return is_event_driven(pdo.transmission_type()); }),
      is_event([](const PdoParameters&, const Bytes& sent, const Bytes& now) { return sent != now; }),
      held_back([](const PdoParameters&, TransmitCause) { return true; }),
      made_up_for([](const PdoParameters&) { return true; }),
      answers_remote(
          [](const PdoParameters& pdo, bool enabled) { return enabled && pdo.cob_id().remote_allowed(); }),
      sampled([](const PdoParameters&, const Bytes&, const Bytes& now) { return now; }),
      carried([](const PdoParameters&, const Bytes& due) { return due; }),
      takes_effect([](const PdoParameters&) { return true; }) {}

TransmitPdo::TransmitPdo(Device& device, const TransmitPdoTerms& terms, std::uint16_t number)
    : device_(&device),
      terms_(&terms),
      parameters_(device, terms.parameters, number),
      timer_(device.pdo_alarms),
      inhibited_until_(device.pdo_alarms) {
  parameters_.on_changed = [this] {
    if (terms_->rules.takes_effect(parameters_)) on_parameters();
  };
}

bool TransmitPdo::enabled() const {
  // What is mapped comes last: to gather it takes the longest, and every SYNC asks.
  return device_->works_now(Service::tpdo) && terms_->rules.valid(parameters_) &&
         (terms_->choices.sent_empty || parameters_.mapped_size() > 0);
}

bool TransmitPdo::timed() const {
  const bool has_one = terms_->rules.has_event_timer(parameters_) || timer_waits_for_sync();
  return has_one && parameters_.event_timer() > Duration::zero();
}

bool TransmitPdo::timer_waits_for_sync() const {
  return terms_->choices.timer_is_event && parameters_.transmission_type() == 0;
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

void TransmitPdo::transmit(const Bytes& due) {
  const Bytes data = terms_->rules.carried(parameters_, due);
  auto frame = conform::can::data_frame(conform::CanId(parameters_.cob_id().can_id()), data);
  frame.extended = parameters_.cob_id().extended();
  device_->send(Service::tpdo, frame);
  sent_ = device_->now;
  reported_ = due;
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

bool TransmitPdo::on_application_change() {
  if (!terms_->choices.change_is_event || !enabled()) return false;
  const Bytes now = content();
  if (!terms_->choices.write_is_event && !terms_->rules.is_event(parameters_, reported_, now)) return false;
  const bool waits = std::exchange(event_, true);
  if (event_driven() && !held_back(TransmitCause::change)) transmit(now);
  return !waits;
}

bool TransmitPdo::shares_an_object_with(const TransmitPdo& other) const {
  const auto mine = parameters_.mapping(), others = other.parameters_.mapping();
  const auto same = [](const Mapped& one, const Mapped& two) {
    return one.index == two.index && one.sub == two.sub;
  };
  return std::ranges::find_first_of(mine, others, same) != mine.end();
}

bool TransmitPdo::held_back(TransmitCause cause) const {
  return inhibited_until_ && device_->now < *inhibited_until_ && terms_->rules.held_back(parameters_, cause);
}

void TransmitPdo::on_sync(std::optional<std::uint8_t> counter) {
  if (!enabled()) return;
  const std::uint8_t type = parameters_.transmission_type();
  if (awaits_start_) {
    if (!terms_->rules.counting_begins(parameters_, counter)) return;
    awaits_start_ = !counter;
    // A cyclic TPDO is sent with the start value itself, and with every n-th SYNC from there.
    if (counter && terms_->choices.sends_at_start_value && type >= 1 && is_synchronous(type))
      syncs_ = type - 1U;
  }
  if (type == remote_synchronous_type) sampled_ = terms_->rules.sampled(parameters_, sampled_, content());
  ++syncs_;
  if (terms_->rules.sent_at_sync(parameters_, syncs_, event_)) transmit(content());
}

bool TransmitPdo::on_remote(const Frame& frame) {
  if (!parameters_.cob_id().names(frame)) return false;
  if (!terms_->rules.answers_remote(parameters_, enabled())) return enabled();
  if (terms_->choices.heeds_remote_dlc && frame.dlc != content().size()) return true;
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

void TransmitPdo::on_parameters() {
  restart();
  if (!enabled()) return;
  if (terms_->choices.timer_goes_on && timer_) {
    timer_ = std::max(sent_ + parameters_.event_timer(), device_->now);
  }
  if (!terms_->choices.sent_when_set) return;
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
  // Where counting begins with a start value it is that which says when the first one comes.
  if (terms_->choices.sends_in_the_middle && !awaits_start_ && type >= 1 && is_synchronous(type))
    syncs_ = (type - 1U) / 2U;
  reported_ = content();
  start_event_timer();
}

void TransmitPdo::on_time() {
  if (inhibited_until_ && device_->now >= *inhibited_until_) {
    inhibited_until_.reset();
    if (event_ && enabled() && event_driven() && terms_->rules.made_up_for(parameters_)) transmit(content());
  }
  if (!timer_ || device_->now < *timer_) return;
  timer_.reset();
  if (!timed() || !enabled()) return;
  if (timer_waits_for_sync() || held_back(TransmitCause::timer)) {
    event_ = true;
  } else {
    transmit(content());
  }
}

}  // namespace refnode
