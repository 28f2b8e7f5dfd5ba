// SPDX-License-Identifier: Apache-2.0
#include "monitor/entries.hpp"

#include <algorithm>

#include "canopen/cob_id.hpp"
#include "canopen/program_control.hpp"

namespace conform::monitor {
namespace {

constexpr Index restore{0x1011};
constexpr std::uint32_t id_and_format = canopen::cob_id::extended_frame | canopen::cob_id::can_id_mask;

bool is_active(Multiplexer object, std::uint32_t value) {
  const auto kind = canopen::cob_id_kind(object);
  return kind && canopen::is_active(*kind, CobId{value});
}

}  // namespace

bool Entries::concerns(Multiplexer object) {
  return object.index.value() >= 0x1000 && object.index.value() <= 0x1FFF;
}

void Entries::asked(Multiplexer object, std::optional<std::uint32_t> value, BusTime time) {
  if (!concerns(object)) return;
  if (value) note_can_id(object, *value, false);
  const auto index = object.index.value();
  // Restored defaults may be in force at once, and a program that starts has its own.
  if (object.index == restore || canopen::is_program_control(object.index)) {
    restoring_ = true;
    return forget_values();
  }
  asked_.insert(key_of(object));
  auto& entry = entries_[key_of(object)];
  if (entry.doubts < 0xFF) ++entry.doubts;
  touched_[index] = time;
  // Without mapped objects a PDO may be not valid whatever was written.
  if (index < 0x1A00 || index > 0x1BFF) return;
  const auto cob_id = entries_.find(key_of(static_cast<std::uint16_t>(index - 0x200), 1));
  if (cob_id == entries_.end()) return;
  auto& pdo = cob_id->second;
  if ((pdo.value & canopen::cob_id::bit31) == 0 || !pdo.by_write) pdo.known = false;
}

void Entries::written(Multiplexer object, std::uint32_t value, BusTime time) {
  if (!concerns(object)) return;
  restored_ = restored_ || object.index == restore;
  const auto found = entries_.find(key_of(object));
  if (found == entries_.end()) return;  // forgotten since the request
  auto& entry = found->second;
  bool certain = true;
  if (is_active(object, value)) {
    // Bits 0 to 29 are locked while the service is active, and the change may be confirmed without effect.
    const bool was_known = entry.known && entry.doubts <= 1;
    certain = was_known && (!is_active(object, entry.value) || ((entry.value ^ value) & id_and_format) == 0);
  }
  entry = {.value = value, .since = time, .by_write = true, .known = certain, .doubts = 0};
  note(object, value, false);
}

void Entries::refused(Multiplexer object, BusTime time) {
  if (object.index == restore) restoring_ = false;
  const auto found = entries_.find(key_of(object));
  if (found == entries_.end()) return;
  auto& entry = found->second;
  if (entry.doubts > 0) --entry.doubts;
  entry.since = time;
}

void Entries::read(Multiplexer object, std::uint32_t value, BusTime time) {
  if (!concerns(object)) return;
  auto& entry = entries_[key_of(object)];
  if (entry.known && entry.doubts == 0 && entry.value == value) return;
  absent_.erase(key_of(object));
  entry = {.value = value, .since = time, .by_write = false, .known = true, .doubts = 0};
  note(object, value, started_ && !asked_.contains(key_of(object)));
}

void Entries::absent(Multiplexer object) {
  if (concerns(object)) absent_.insert(key_of(object));
}

void Entries::reset() {
  // What comes back then nobody has seen.
  if (restored_ || restoring_) seen_bits_.clear();
  restored_ = restoring_ = false;
  started_ = true;
  forget_values();
}

void Entries::lose_track() {
  seen_bits_.clear();
  started_ = false;
  forget_values();
}

void Entries::forget_values() {
  for (const auto& [place, entry] : entries_) {
    if (entry.doubts > 0) open_.insert(place);
  }
  entries_.clear();
  asked_.clear();
}

bool Entries::never_had(std::uint16_t index, std::uint8_t sub, std::uint32_t bits) const {
  const auto place = key_of(index, sub);
  const auto found = seen_bits_.find(place);
  if (found == seen_bits_.end() || (found->second & bits) != 0 || restored_ || restoring_ ||
      open_.contains(place))
    return false;
  const auto entry = entries_.find(place);
  return entry == entries_.end() || entry->second.doubts == 0;
}

void Entries::note(Multiplexer object, std::uint32_t value, bool of_start) {
  auto& most = most_[key_of(object)];
  most = std::max(most, value);
  const auto seen = seen_bits_.find(key_of(object));
  if (seen != seen_bits_.end())
    seen->second |= value;
  else if (of_start)
    seen_bits_.emplace(key_of(object), value);
  note_can_id(object, value, is_active(object, value));
}

void Entries::note_can_id(Multiplexer object, std::uint32_t value, bool in_use) {
  if (!canopen::cob_id_kind(object)) return;
  const auto key =
      canopen::is_extended(CobId{value}) ? value & id_and_format : value & canopen::cob_id::base_id_mask;
  // What is not used holds anything, 000h most of all.
  if (canopen::is_restricted(CanId{key}) && !in_use) return;
  held_.insert(key);
  held_by_.emplace(key, object.index.value());
}

const Entries::Entry* Entries::known(std::uint16_t index, std::uint8_t sub) const {
  const auto found = entries_.find(key_of(index, sub));
  if (found == entries_.end() || !found->second.known || found->second.doubts > 0) return nullptr;
  return &found->second;
}

bool Entries::is_zero(std::uint16_t index, std::uint8_t sub) const {
  if (is_absent(index, sub)) return true;
  const auto* entry = known(index, sub);
  return entry != nullptr && entry->value == 0;
}

bool Entries::is_told(std::uint16_t index, std::uint8_t sub) const {
  return is_absent(index, sub) || most_.contains(key_of(index, sub));
}

std::uint32_t Entries::most(std::uint16_t index, std::uint8_t sub) const {
  const auto found = most_.find(key_of(index, sub));
  return found == most_.end() ? 0 : found->second;
}

BusTime Entries::touched(std::uint16_t first, std::uint16_t last) const {
  BusTime out{};
  for (auto each = touched_.lower_bound(first); each != touched_.end() && each->first <= last; ++each)
    out = std::max(out, each->second);
  return out;
}

}  // namespace conform::monitor
