// SPDX-License-Identifier: Apache-2.0
#include "pdo_parameters.hpp"

namespace refnode {

namespace {

constexpr std::uint8_t type_sub = 2;
constexpr std::uint8_t inhibit_sub = 3;
constexpr std::uint8_t event_timer_sub = 5;

// 0001h-0007h as placeholders of an RPDO. BOOLEAN is left out: mapping is by whole bytes.
std::size_t dummy_size(std::uint16_t index) {
  if (index < 0x0002 || index > 0x0007) return 0;
  return fixed_size(static_cast<DataType>(index));
}

}  // namespace

PdoParameters::PdoParameters(Device& device, PdoDirection direction, std::uint8_t number,
                             std::uint32_t cob_id, const std::vector<std::uint32_t>& mapping)
    : device_(&device),
      direction_(direction),
      communication_(
          static_cast<std::uint16_t>((direction == PdoDirection::receive ? 0x1400 : 0x1800) + number)),
      mapping_(static_cast<std::uint16_t>(communication_ + 0x200)),
      cob_id_(device, direction == PdoDirection::receive ? CobIdUse::rpdo : CobIdUse::tpdo, communication_, 1,
              cob_id) {
  ObjectDictionary& od = device.dictionary;
  const bool receive = direction == PdoDirection::receive;
  od.add_complex(communication_, receive ? "RPDO communication parameter" : "TPDO communication parameter",
                 ObjectKind::record);
  od.add_sub(communication_, 1, cob_id_.entry("COB-ID"));
  Entry& type = od.add_sub(communication_, type_sub,
                           integer_entry("Transmission type", DataType::unsigned8, Access::rw, 0xFF));
  type.check = [this](ByteView bytes) { return check_type(bytes); };
  Entry& inhibit = od.add_sub(communication_, inhibit_sub,
                              integer_entry("Inhibit time", DataType::unsigned16, Access::rw, 0));
  inhibit.check = [this](ByteView bytes) { return check_locked(inhibit_sub, bytes); };
  // Sub-index 04h is reserved and left out.
  od.add_sub(communication_, event_timer_sub,
             integer_entry("Event timer", DataType::unsigned16, Access::rw, 0));

  od.add_complex(mapping_, receive ? "RPDO mapping parameter" : "TPDO mapping parameter", ObjectKind::record);
  for (std::uint8_t sub = 1; sub <= mapping_entries; ++sub) {
    const std::uint32_t value = sub <= mapping.size() ? mapping[sub - 1U] : 0;
    Entry& entry =
        od.add_sub(mapping_, sub, integer_entry("Mapped object", DataType::unsigned32, Access::rw, value));
    entry.check = [this, sub](ByteView bytes) { return check_mapping_entry(sub, bytes); };
  }
  Entry& count =
      od.add_sub(mapping_, 0,
                 integer_entry("Number of mapped objects", DataType::unsigned8, Access::rw, mapping.size()));
  count.check = [this](ByteView bytes) { return check_mapping_count(bytes); };

  const auto changed = [this] {
    if (on_changed) on_changed();
  };
  count.written = changed;
  for (auto& [sub, entry] : od.objects()[communication_].entries) entry.written = changed;
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
  const auto value = static_cast<std::int64_t>(device_->dictionary.number(communication_, inhibit_sub));
  return std::chrono::microseconds(value * faults().inhibit_unit_us);
}

Duration PdoParameters::event_timer() const {
  const auto value = static_cast<std::int64_t>(device_->dictionary.number(communication_, event_timer_sub));
  return std::chrono::milliseconds(value * faults().event_timer_factor);
}

// 00h-F0h synchronous, FCh and FDh on remote request (TPDO only), FEh and FFh event-driven; the rest is
// reserved.
Accepted PdoParameters::check_type(ByteView bytes) const {
  const std::uint64_t type = conform::load_le(bytes);
  const bool remote = type == 0xFC || type == 0xFD;
  const PdoChoices& choice = choices();
  const bool supported = (type <= 0xF0 && choice.synchronous_types) || (type >= 0xFE && choice.event_types) ||
                         (remote && direction_ == PdoDirection::transmit && choice.remote_types);
  if (!supported && !faults().reserved_type_accepted) return refuse(abort_code::invalid_value);
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

Accepted PdoParameters::mappable(const Mapped& mapped) const {
  const PdoFaults& fault = faults();
  const PdoChoices& choice = choices();
  if (direction_ == PdoDirection::receive && mapped.sub == 0 && dummy_size(mapped.index) != 0) {
    if (mapped.bits != dummy_size(mapped.index) * 8) return refuse(choice.wrong_length);
    return {};
  }
  const Entry* entry = device_->dictionary.entry(mapped.index, mapped.sub);
  if (entry == nullptr) return fault.absent_object_mapped ? Accepted{} : refuse(choice.absent_object);
  const bool allowed = direction_ == PdoDirection::receive ? entry->rx_mappable : entry->tx_mappable;
  if (!allowed && !fault.unmappable_object_mapped) return refuse(choice.unmappable_object);
  if (mapped.bits != entry->value.size() * 8 && !fault.mapping_length_unchecked)
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
  if (count > mapping_entries) {
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
  const std::uint64_t count = device_->dictionary.number(mapping_, 0);
  for (std::uint8_t sub = 1; sub <= count && sub <= mapping_entries; ++sub) {
    all.push_back(unpack(device_->dictionary.number(mapping_, sub)));
  }
  return all;
}

std::size_t PdoParameters::mapped_size() const {
  std::size_t bits = 0;
  for (const Mapped& mapped : mapping()) bits += mapped.bits;
  return bits / 8 < 8 ? bits / 8 : 8;
}

}  // namespace refnode
