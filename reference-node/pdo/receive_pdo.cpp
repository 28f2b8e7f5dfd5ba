// SPDX-License-Identifier: Apache-2.0
#include "pdo/receive_pdo.hpp"

#include <utility>

#include "pdo/bits.hpp"

namespace refnode {

namespace {

// CiA 301, table 26
constexpr std::uint16_t too_short = 0x8210;
constexpr std::uint16_t too_long = 0x8220;
constexpr std::uint16_t event_timer_elapsed = 0x8250;

}  // namespace

ReceivePdoRules::ReceivePdoRules()
    : valid([](const PdoParameters& pdo) { return pdo.cob_id().valid(); }),
      processed(
          [](const PdoParameters&, std::size_t received, std::size_t mapped) { return received >= mapped; }),
      waits_for_sync([](const PdoParameters& pdo) { return is_synchronous(pdo.transmission_type()); }),
      kept_for_sync(
          [](const PdoParameters&, const std::optional<Bytes>&, const Bytes& received) { return received; }),
      taken_at_sync([](const PdoParameters&, const Bytes& waiting) { return waiting; }),
      due_at_sync([](const PdoParameters&, std::uint32_t) { return true; }),
      watched_from_start([](const PdoParameters&) { return false; }) {}

ReceivePdo::ReceivePdo(Device& device, const ReceivePdoTerms& terms, std::uint16_t number)
    : device_(&device),
      terms_(&terms),
      number_(number),
      parameters_(device, terms.parameters, number),
      deadline_(device.pdo_alarms) {
  parameters_.on_changed = [this] { forget(); };
}

// What waits was for the PDO as it was.
void ReceivePdo::forget() {
  buffered_.reset();
  unjudged_.reset();
  if (!deadline_ && !terms_->rules.watched_from_start(parameters_)) return;
  deadline_.reset();
  if (device_->works_now(Service::rpdo) && terms_->rules.valid(parameters_)) start_deadline();
}

bool ReceivePdo::on_frame(const Frame& frame) {
  if (!terms_->rules.valid(parameters_) || !parameters_.cob_id().names(frame)) return false;
  if (!device_->works_now(Service::rpdo)) return true;
  const std::size_t size = parameters_.mapped_size();
  if (size == 0) return true;

  if (terms_->choices.judged_at_sync && terms_->rules.waits_for_sync(parameters_)) {
    unjudged_ = frame.size();
  } else {
    judge_length(frame.size());
  }
  if (!terms_->rules.processed(parameters_, frame.size(), size)) return true;
  start_deadline();

  const Bytes data(frame.data.begin(), frame.data.begin() + static_cast<std::ptrdiff_t>(size));
  if (terms_->rules.waits_for_sync(parameters_)) {
    if (terms_->in_window()) {
      buffered_ = terms_->rules.kept_for_sync(parameters_, buffered_, data);
      syncs_ = 0;
    }
  } else {
    apply(data);
  }
  return true;
}

void ReceivePdo::judge_length(std::size_t received) {
  const std::size_t size = parameters_.mapped_size();
  const auto detail = static_cast<std::uint8_t>(received);
  if (received < size) {
    device_->errors.raise(cause(too_short), detail);
  } else {
    device_->errors.clear(cause(too_short));
  }
  if (!terms_->rules.processed(parameters_, received, size)) return;
  if (received <= size) {
    device_->errors.clear(cause(too_long));
  } else if (terms_->choices.too_long_reported) {
    device_->errors.raise(cause(too_long), detail);
  }
}

void ReceivePdo::on_sync() {
  if (const auto received = std::exchange(unjudged_, std::nullopt);
      received && device_->works_now(Service::rpdo))
    judge_length(*received);
  if (!buffered_ || !terms_->rules.due_at_sync(parameters_, ++syncs_)) return;
  if (device_->works_now(Service::rpdo)) apply(terms_->rules.taken_at_sync(parameters_, *buffered_));
  buffered_.reset();
}

void ReceivePdo::on_state_change() {
  buffered_.reset();
  unjudged_.reset();
  deadline_.reset();
  const bool watched = device_->works_now(Service::rpdo) && terms_->rules.watched_from_start(parameters_);
  if (watched && terms_->rules.valid(parameters_)) start_deadline();
}

// The event timer of an RPDO: the next one has to come before it has elapsed.
void ReceivePdo::start_deadline() {
  const Duration limit = parameters_.event_timer();
  deadline_.reset();
  if (limit > Duration::zero()) deadline_ = device_->now + limit;
  device_->errors.clear(cause(event_timer_elapsed));
}

void ReceivePdo::on_time() {
  if (!deadline_ || device_->now < *deadline_) return;
  deadline_.reset();
  device_->errors.raise(cause(event_timer_elapsed), 0);
}

void ReceivePdo::apply(const Bytes& data) {
  applying_ = true;
  std::size_t position = 0;  // in bits
  for (const Mapped& mapped : parameters_.mapping()) {
    if (position + mapped.bits > data.size() * 8) break;
    // A placeholder has no data, also where the entry of its type can be read.
    const bool placeholder = mapped.index <= 0x1F;
    Entry* entry = placeholder ? nullptr : device_->dictionary.entry(mapped.index, mapped.sub);
    if (entry != nullptr && entry->value.size() == whole_bytes(mapped.bits)) {
      entry->value.assign(entry->value.size(), 0);
      copy_bits(data, position, entry->value, 0, mapped.bits);
      if (entry->written) entry->written();
    }
    position += mapped.bits;
  }
  applying_ = false;
  if (on_applied) on_applied();
}

}  // namespace refnode
