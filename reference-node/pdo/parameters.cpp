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

void add_pdo_objects(ObjectDictionary& od, PdoDirection direction, std::uint32_t cob_id,
                     const std::vector<std::uint32_t>& mapping) {
  constexpr std::uint8_t entries = 8;
  const bool receive = direction == PdoDirection::receive;
  const std::uint16_t index = first_communication_index(direction);
  od.add_complex(index, receive ? "RPDO communication parameter" : "TPDO communication parameter",
                 ObjectKind::record);
  od.add_sub(index, 1, integer_entry("COB-ID", DataType::unsigned32, Access::rw, cob_id));
  od.add_sub(index, type_sub, integer_entry("Transmission type", DataType::unsigned8, Access::rw, 0xFF));
  od.add_sub(index, inhibit_sub, integer_entry("Inhibit time", DataType::unsigned16, Access::rw, 0));
  // Sub-index 04h is reserved and left out.
  od.add_sub(index, event_timer_sub, integer_entry("Event timer", DataType::unsigned16, Access::rw, 0));

  const auto mapped = static_cast<std::uint16_t>(index + to_mapping);
  od.add_complex(mapped, receive ? "RPDO mapping parameter" : "TPDO mapping parameter", ObjectKind::record);
  for (std::uint8_t sub = 1; sub <= entries; ++sub) {
    const std::uint32_t value = sub <= mapping.size() ? mapping[sub - 1U] : 0;
    od.add_sub(mapped, sub, integer_entry("Mapped object", DataType::unsigned32, Access::rw, value));
  }
  od.add_sub(mapped, 0,
             integer_entry("Number of mapped objects", DataType::unsigned8, Access::rw, mapping.size()));
}

PdoParameters::PdoParameters(Device& device, const CobIdRules& cob_id_rules, PdoDirection direction,
                             std::uint16_t number)
    : device_(&device),
      direction_(direction),
      communication_(static_cast<std::uint16_t>(first_communication_index(direction) + number)),
      mapping_(static_cast<std::uint16_t>(communication_ + to_mapping)),
      cob_id_(device, cob_id_rules, communication_, cob_id_sub, 0) {
  ObjectDictionary& od = device.dictionary;
  cob_id_.bind();
  if (Entry* type = od.entry(communication_, type_sub))
    type->check = [this](ByteView bytes) { return check_type(bytes); };
  if (Entry* inhibit = od.entry(communication_, inhibit_sub))
    inhibit->check = [this](ByteView bytes) { return check_locked(inhibit_sub, bytes); };
  Entry* start = od.entry(communication_, sync_start_sub);
  if (start != nullptr && direction == PdoDirection::transmit)
    start->check = [this](ByteView bytes) { return check_sync_start(bytes); };

  const auto changed = [this] {
    if (on_changed) on_changed();
  };
  if (const auto found = od.objects().find(communication_); found != od.objects().end()) {
    for (auto& [sub, entry] : found->second.entries) entry.written = changed;
  }
  if (Entry* cob_id = od.entry(communication_, cob_id_sub)) {
    cob_id->written = [this, changed, cob_id] {
      if (choices().needs_mapping && mapped_size() == 0) cob_id->value.back() |= 0x80U;
      changed();
    };
  }
  const auto mapping = od.objects().find(mapping_);
  if (mapping == od.objects().end()) return;
  for (auto& [sub, entry] : mapping->second.entries) {
    if (sub == 0 || sub > most_mapped) continue;
    mapping_entries_ = sub;
    entry.check = [this, which = sub](ByteView bytes) { return check_mapping_entry(which, bytes); };
  }
  if (Entry* count = od.entry(mapping_, 0)) {
    multiplexed_ = device.described && conform::load_le(count->default_value) >= first_multiplexed;
    count->check = [this](ByteView bytes) { return check_mapping_count(bytes); };
    count->written = changed;
  }
}

const PdoFaults& PdoParameters::faults() const {
  return direction_ == PdoDirection::receive ? device_->behaviour.rpdo : device_->behaviour.tpdo;
}

const PdoChoices& PdoParameters::choices() const {
  return direction_ == PdoDirection::receive ? device_->choices.rpdo : device_->choices.tpdo;
}

std::uint8_t PdoParameters::transmission_type() const {
  return static_cast<std::uint8_t>(device_->dictionary.number(communication_, type_sub, 0xFF));
}

Duration PdoParameters::inhibit_time() const {
  // In units of 100 us.
  return std::chrono::microseconds(device_->time_value(communication_, inhibit_sub) *
                                   faults().inhibit_unit_us);
}

Duration PdoParameters::event_timer() const {
  return std::chrono::milliseconds(device_->time_value(communication_, event_timer_sub) *
                                   faults().event_timer_factor);
}

std::uint64_t PdoParameters::sync_start() const {
  return device_->dictionary.number(communication_, sync_start_sub);
}

// 00h-F0h synchronous, FCh and FDh on remote request (TPDO only), FEh and FFh event-driven; the rest is
// reserved.
Accepted PdoParameters::check_type(ByteView bytes) const {
  const std::uint64_t type = conform::load_le(bytes);
  const bool remote = type == 0xFC || type == 0xFD;
  const PdoChoices& choice = choices();
  // What a description begins with is supported, by its word.
  if (device_->described && type == transmission_type()) return {};
  const bool supported = (type <= 0xF0 && choice.synchronous_types) || (type >= 0xFE && choice.event_types) ||
                         (remote && direction_ == PdoDirection::transmit && choice.remote_types);
  if (!supported && !faults().reserved_type_accepted) return refuse(abort_code::invalid_value);
  return {};
}

Accepted PdoParameters::check_sync_start(ByteView bytes) const {
  if (auto free = check_locked(sync_start_sub, bytes); !free) return free;
  if (conform::load_le(bytes) > most_sync_start) return refuse(abort_code::invalid_value);
  return {};
}

Accepted PdoParameters::check_locked(std::uint8_t sub, ByteView bytes) const {
  const bool changed = conform::load_le(bytes) != device_->dictionary.number(communication_, sub);
  if (changed && cob_id_.valid() && !faults().inhibit_lock_missing) return refuse(choices().inhibit_locked);
  return {};
}

// Index in bits 31-16, sub-index in bits 15-8, length in bits in bits 7-0.
PdoParameters::Mapped PdoParameters::unpack(std::uint64_t value) {
  return {static_cast<std::uint16_t>(value >> 16U), static_cast<std::uint8_t>((value >> 8U) & 0xFFU),
          static_cast<std::uint8_t>(value & 0xFFU)};
}

// 0001h-0007h as placeholders of an RPDO; 0 when there is none of this index.
unsigned PdoParameters::placeholder_bits(std::uint16_t index) const {
  if (index == 0 || index >= device_->placeholders.size() || !device_->placeholders[index]) return 0;
  const auto type = static_cast<DataType>(index);
  return type == DataType::boolean ? 1 : static_cast<unsigned>(fixed_size(type) * 8);
}

Accepted PdoParameters::mappable(const Mapped& mapped) const {
  const PdoFaults& fault = faults();
  const PdoChoices& choice = choices();
  const unsigned placeholder = placeholder_bits(mapped.index);
  if (direction_ == PdoDirection::receive && mapped.sub == 0 && placeholder != 0) {
    if (mapped.bits != placeholder) return refuse(choice.wrong_length);
    return {};
  }
  const Entry* entry = device_->dictionary.entry(mapped.index, mapped.sub);
  if (entry == nullptr) return fault.absent_object_mapped ? Accepted{} : refuse(choice.absent_object);
  const bool allowed = direction_ == PdoDirection::receive ? entry->rx_mappable : entry->tx_mappable;
  if (!allowed && !fault.unmappable_object_mapped) return refuse(choice.unmappable_object);
  const bool one_bit = entry->type == DataType::boolean && mapped.bits == 1;
  if (mapped.bits != entry->value.size() * 8 && !one_bit && !fault.mapping_length_unchecked)
    return refuse(choice.wrong_length);
  return {};
}

Accepted PdoParameters::check_mapping_entry(std::uint8_t sub, ByteView bytes) const {
  const std::uint64_t value = conform::load_le(bytes);
  if (value == device_->dictionary.number(mapping_, sub)) return {};
  // The procedure is: PDO not valid, sub-index 00h := 00h, then the entries.
  const bool enabled = device_->dictionary.number(mapping_, 0) != 0;
  if ((enabled || cob_id_.valid()) && !faults().mapping_writable_while_enabled)
    return refuse(choices().out_of_order);
  if (value == 0) return {};  // an unused entry
  if (choices().checked_at_count) return {};
  return mappable(unpack(value));
}

Accepted PdoParameters::check_mapping_count(ByteView bytes) const {
  const std::uint64_t count = conform::load_le(bytes);
  const PdoFaults& fault = faults();
  if (count == device_->dictionary.number(mapping_, 0)) return {};
  if (cob_id_.valid() && !fault.mapping_writable_while_valid) return refuse(choices().out_of_order);
  if (count > mapping_entries_) {
    return fault.mapping_count_unchecked ? Accepted{} : refuse(choices().too_many);
  }
  std::size_t bits = 0;
  for (std::uint64_t entry = 1; entry <= count; ++entry) {
    const std::uint64_t value = device_->dictionary.number(mapping_, static_cast<std::uint8_t>(entry));
    if (value == 0) return refuse(abort_code::not_mappable);
    if (const Accepted good = mappable(unpack(value)); !good) return good;
    bits += unpack(value).bits;
  }
  if (bits > 64 && !fault.overlong_mapping_accepted) return refuse(choices().too_long);
  return {};
}

std::vector<PdoParameters::Mapped> PdoParameters::mapping() const {
  std::vector<Mapped> all;
  if (multiplexed_) return all;
  const std::uint64_t count = device_->dictionary.number(mapping_, 0);
  for (std::uint8_t sub = 1; sub <= count && sub <= mapping_entries_; ++sub) {
    all.push_back(unpack(device_->dictionary.number(mapping_, sub)));
  }
  return all;
}

std::size_t PdoParameters::mapped_size() const {
  std::size_t bits = 0;
  for (const Mapped& mapped : mapping()) bits += mapped.bits;
  return std::min<std::size_t>((bits + 7) / 8, 8);
}

}  // namespace refnode
