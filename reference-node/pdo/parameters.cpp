// SPDX-License-Identifier: Apache-2.0
#include "pdo/parameters.hpp"

#include <algorithm>

namespace refnode {

namespace {

constexpr std::uint8_t cob_id_sub = 1;
constexpr std::uint8_t type_sub = 2;
constexpr std::uint8_t inhibit_sub = 3;
constexpr std::uint8_t event_timer_sub = 5;
constexpr std::uint8_t sync_start_sub = 6;  // TPDO
constexpr std::uint64_t most_sync_start = 240;

constexpr std::uint16_t to_mapping = 0x200;  // from 14xxh to 16xxh, from 18xxh to 1Axxh
constexpr std::uint8_t most_mapped = 0x40;
constexpr std::uint64_t first_multiplexed = 0xFE;  // FEh and FFh in sub-index 00h of the mapping

}  // namespace

void add_pdo_objects(ObjectDictionary& od, PdoDirection direction, std::uint16_t number, std::uint32_t cob_id,
                     std::uint8_t node_id, const std::vector<std::uint32_t>& mapping) {
  constexpr std::uint8_t entries = 8;
  const bool receive = direction == PdoDirection::receive;
  const auto index = static_cast<std::uint16_t>(first_communication_index(direction) + number);
  od.add_complex(index, receive ? "RPDO communication parameter" : "TPDO communication parameter",
                 ObjectKind::record);
  od.add_sub(index, 1, cob_id_entry("COB-ID", Access::rw, cob_id, node_id));
  od.add_sub(index, type_sub, integer_entry("Transmission type", DataType::unsigned8, Access::rw, 0xFF));
  od.add_sub(index, inhibit_sub, integer_entry("Inhibit time", DataType::unsigned16, Access::rw, 0));
  // Sub-index 04h is reserved and left out.
  od.add_sub(index, event_timer_sub, integer_entry("Event timer", DataType::unsigned16, Access::rw, 0));
  if (!receive) {
    od.add_sub(index, sync_start_sub, integer_entry("SYNC start value", DataType::unsigned8, Access::rw, 0));
  }

  const auto mapped = static_cast<std::uint16_t>(index + to_mapping);
  od.add_complex(mapped, receive ? "RPDO mapping parameter" : "TPDO mapping parameter", ObjectKind::record);
  for (std::uint8_t sub = 1; sub <= entries; ++sub) {
    const std::uint32_t value = sub <= mapping.size() ? mapping[sub - 1U] : 0;
    od.add_sub(mapped, sub, integer_entry("Mapped object", DataType::unsigned32, Access::rw, value));
  }
  od.add_sub(mapped, 0,
             integer_entry("Number of mapped objects", DataType::unsigned8, Access::rw, mapping.size()));
}

PdoParameters::PdoParameters(Device& device, const PdoTerms& terms, std::uint16_t number)
    : device_(&device),
      terms_(&terms),
      number_(number),
      communication_(static_cast<std::uint16_t>(first_communication_index(terms.direction) + number)),
      mapping_(static_cast<std::uint16_t>(communication_ + to_mapping)),
      cob_id_(device, terms.cob_id_rules, communication_, cob_id_sub, 0) {
  cob_id_.bind();
  bind_communication();
  bind_mapping();
}

void PdoParameters::bind_communication() {
  ObjectDictionary& od = device_->dictionary;
  if (Entry* type = od.entry(communication_, type_sub))
    type->check = [this](ByteView bytes) { return check_type(bytes); };
  if (Entry* inhibit = od.entry(communication_, inhibit_sub))
    inhibit->check = [this](ByteView bytes) { return check_inhibit_time(bytes); };
  Entry* start = od.entry(communication_, sync_start_sub);
  if (start != nullptr && terms_->direction == PdoDirection::transmit)
    start->check = [this](ByteView bytes) { return check_sync_start(bytes); };

  if (const auto found = od.objects().find(communication_); found != od.objects().end()) {
    for (auto& [sub, entry] : found->second.entries) entry.written = [this] { changed(); };
  }
  if (Entry* cob_id = od.entry(communication_, cob_id_sub)) {
    cob_id->written = [this, cob_id] {
      if (terms_->choices.needs_mapping && mapped_size() == 0) cob_id->value.back() |= 0x80U;
      changed();
    };
  }
}

void PdoParameters::bind_mapping() {
  ObjectDictionary& od = device_->dictionary;
  const auto mapping = od.objects().find(mapping_);
  if (mapping == od.objects().end()) return;
  for (auto& [sub, entry] : mapping->second.entries) {
    if (sub == 0 || sub > most_mapped) continue;
    mapping_entries_ = sub;
    entry.check = [this, which = sub](ByteView bytes) { return check_mapping_entry(which, bytes); };
  }
  if (Entry* count = od.entry(mapping_, 0)) {
    multiplexed_ = device_->described && conform::load_le(count->default_value) >= first_multiplexed;
    count->check = [this](ByteView bytes) { return check_mapping_count(bytes); };
    count->written = [this] { changed(); };
  }
}

void PdoParameters::changed() const {
  if (on_changed) on_changed();
}

std::uint8_t PdoParameters::transmission_type() const {
  return static_cast<std::uint8_t>(device_->dictionary.number(communication_, type_sub, 0xFF));
}

Duration PdoParameters::inhibit_time() const {
  return terms_->rules.inhibit_time(*this, device_->time_value(communication_, inhibit_sub));
}

Duration PdoParameters::event_timer() const {
  return terms_->rules.event_timer(*this, device_->time_value(communication_, event_timer_sub));
}

std::uint64_t PdoParameters::sync_start() const {
  return device_->dictionary.number(communication_, sync_start_sub);
}

bool PdoParameters::locked(PdoPart part) const {
  return terms_->rules.locked(*this, part, cob_id_.valid(), device_->dictionary.number(mapping_, 0) != 0);
}

Accepted PdoParameters::check_type(ByteView bytes) const {
  const std::uint64_t type = conform::load_le(bytes);
  const PdoChoices& choices = terms_->choices;
  // What a description begins with is supported, by its word.
  if (device_->described && type == transmission_type()) return {};
  const bool transmit = terms_->direction == PdoDirection::transmit;
  const bool some_syncs = type == 0 ? choices.acyclic_type : type <= choices.most_syncs;
  const bool supported = (is_synchronous(type) && choices.synchronous_types && some_syncs) ||
                         (is_event_driven(type) && choices.event_types) ||
                         (is_on_remote_request(type) && transmit && choices.remote_types);
  if (!supported) return refuse(abort_code::invalid_value);
  return {};
}

Accepted PdoParameters::check_inhibit_time(ByteView bytes) const {
  const bool moved = conform::load_le(bytes) != device_->dictionary.number(communication_, inhibit_sub);
  if (moved && locked(PdoPart::inhibit_time)) return refuse(terms_->choices.inhibit_locked);
  return {};
}

Accepted PdoParameters::check_sync_start(ByteView bytes) const {
  const std::uint64_t start = conform::load_le(bytes);
  if (start != sync_start() && locked(PdoPart::sync_start)) return refuse(terms_->choices.inhibit_locked);
  if (start > most_sync_start) return refuse(abort_code::invalid_value);
  return {};
}

Accepted PdoParameters::check_mapping_entry(std::uint8_t sub, ByteView bytes) const {
  const std::uint64_t value = conform::load_le(bytes);
  if (value == device_->dictionary.number(mapping_, sub)) return {};
  if (locked(PdoPart::mapped_object)) return refuse(terms_->choices.out_of_order);
  if (value == 0) return {};  // an unused entry
  if (terms_->choices.checked_at_count) return {};
  return terms_->rules.mappable(Mapped::unpack(value));
}

Accepted PdoParameters::check_mapping_count(ByteView bytes) const {
  const std::uint64_t count = conform::load_le(bytes);
  if (count == device_->dictionary.number(mapping_, 0)) return {};
  if (locked(PdoPart::mapping)) return refuse(terms_->choices.out_of_order);
  if (count > mapping_entries_) return refuse(terms_->choices.too_many);
  std::size_t bits = 0;
  for (std::uint64_t entry = 1; entry <= count; ++entry) {
    const std::uint64_t value = device_->dictionary.number(mapping_, static_cast<std::uint8_t>(entry));
    if (value == 0) return refuse(abort_code::not_mappable);
    const Mapped mapped = Mapped::unpack(value);
    if (const Accepted good = terms_->rules.mappable(mapped); !good) return good;
    bits += mapped.bits;
  }
  if (bits > 64) return refuse(terms_->choices.too_long);
  return {};
}

std::vector<Mapped> PdoParameters::mapping() const {
  std::vector<Mapped> all;
  if (multiplexed_) return all;
  const std::uint64_t count = device_->dictionary.number(mapping_, 0);
  all.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(count, mapping_entries_)));
  for (std::uint8_t sub = 1; sub <= count && sub <= mapping_entries_; ++sub) {
    all.push_back(Mapped::unpack(device_->dictionary.number(mapping_, sub)));
  }
  return terms_->rules.mapping(*this, all);
}

std::size_t PdoParameters::mapped_size() const {
  std::size_t bits = 0;
  for (const Mapped& mapped : mapping()) bits += mapped.bits;
  return std::min<std::size_t>((bits + 7) / 8, 8);
}

}  // namespace refnode
