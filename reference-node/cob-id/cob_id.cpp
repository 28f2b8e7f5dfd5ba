// SPDX-License-Identifier: Apache-2.0
#include "cob-id/cob_id.hpp"

namespace refnode {

namespace {

constexpr std::uint32_t bit31 = 0x80000000;  // EMCY, PDO, SDO: not valid; TIME: consume
constexpr std::uint32_t bit30 = 0x40000000;  // SYNC: generate; TIME: produce; EMCY: reserved; TPDO: no RTR
constexpr std::uint32_t bit29 = 0x20000000;  // 29-bit identifier
constexpr std::uint32_t can_id_mask = 0x000007FF;
constexpr std::uint32_t extended_id_mask = 0x1FFFFFFF;
constexpr std::uint32_t upper_id_bits = 0x1FFFF800;  // must be 0 with an 11-bit identifier

bool is_emergency(CobIdUse use) { return use == CobIdUse::emergency || use == CobIdUse::emergency_consumer; }
bool is_sync_or_time(CobIdUse use) { return use == CobIdUse::sync || use == CobIdUse::time; }

// While this holds before and after a write, bits 29-0 stay as they are. Taking the object out of use and
// moving it in one write is allowed: nothing was changed while it existed.
bool exists(CobIdUse use, std::uint32_t value) {
  switch (use) {
    case CobIdUse::sync: return (value & bit30) != 0;
    case CobIdUse::time: return (value & (bit31 | bit30)) != 0;
    default: return (value & bit31) == 0;
  }
}

bool is_valid(CobIdUse use, std::uint32_t value) {
  switch (use) {
    case CobIdUse::sync: return true;
    case CobIdUse::time: return (value & bit31) != 0;
    default: return (value & bit31) == 0;
  }
}

}  // namespace

bool restricted_can_id(std::uint32_t id) {
  struct Span {
    std::uint32_t first, last;
  };
  constexpr Span spans[] = {{0x000, 0x07F}, {0x101, 0x180}, {0x581, 0x5FF}, {0x601, 0x67F},
                            {0x6E0, 0x6FF}, {0x701, 0x77F}, {0x780, 0x7FF}};
  for (const Span& span : spans) {
    if (id >= span.first && id <= span.last) return true;
  }
  return false;
}

CobIdRules::CobIdRules(CobIdUse of)
    : use(of),
      frame_bit_allowed([](std::uint32_t value) { return (value & bit29) == 0; }),
      bit30_allowed([of](std::uint32_t value) { return (value & bit30) == 0 || !is_emergency(of); }),
      upper_bits_allowed(
          [](std::uint32_t value) { return (value & bit29) != 0 || (value & upper_id_bits) == 0; }),
      locked([of](std::uint32_t value) { return exists(of, value); }),
      valid([of](std::uint32_t value) { return is_valid(of, value); }),
      remote_allowed([](std::uint32_t value) { return (value & bit30) == 0; }),
      produced([](std::uint32_t value) { return (value & bit30) != 0; }),
      can_id([](std::uint32_t value, std::uint32_t) { return value & can_id_mask; }) {}

CobId::CobId(Device& device, const CobIdRules& rules, std::uint16_t index, std::uint8_t sub,
             std::uint32_t default_value)
    : device_(&device), rules_(&rules), index_(index), sub_(sub), default_(default_value) {}

void CobId::bind() {
  Entry* entry = device_->dictionary.entry(index_, sub_);
  if (entry == nullptr) return;
  default_ = static_cast<std::uint32_t>(conform::load_le(entry->default_value));
  entry->check = [cob_id = *this](ByteView bytes) { return cob_id.check(bytes); };
}

std::uint32_t CobId::value() const {
  return static_cast<std::uint32_t>(device_->dictionary.number(index_, sub_, default_));
}

Accepted CobId::check(ByteView bytes) const {
  const auto wanted = static_cast<std::uint32_t>(conform::load_le(bytes));
  const std::uint32_t present = value();
  const CobIdChoices& choice = rules_->choices;

  if (wanted == present) return {};
  if (!serves_extended() && !rules_->frame_bit_allowed(wanted)) return refuse(choice.frame_bit);
  if (!rules_->bit30_allowed(wanted)) return refuse(choice.fixed_bit);
  if (is_sync_or_time(rules_->use) && !choice.produced && (wanted & bit30) != 0)
    return refuse(choice.fixed_bit);
  if (rules_->use == CobIdUse::tpdo && !choice.remote_frames && (wanted & bit30) == 0)
    return refuse(choice.fixed_bit);
  if (!rules_->upper_bits_allowed(wanted)) return refuse(choice.upper_bits);
  const bool moved = ((wanted ^ present) & ~(bit31 | bit30)) != 0;
  if (moved && choice.only_valid_bit) return refuse(choice.locked);
  if (moved && rules_->locked(present) && (rules_->locked(wanted) || choice.locked_by_former_value))
    return refuse(choice.locked);
  // SYNC and TIME have no bit that takes them out of use altogether: their CAN-ID is always looked at. 000h
  // in an entry that is not valid names no CAN-ID yet: the default of many of them (8000 0000h).
  const bool in_use = is_sync_or_time(rules_->use) || (wanted & bit31) == 0;
  const bool looked_at = in_use || (choice.restricted_always && (wanted & can_id_mask) != 0);
  if (looked_at && !(serves_extended() && (wanted & bit29) != 0) && rules_->restricted(wanted & can_id_mask))
    return refuse(choice.restricted);
  return {};
}

// A described PDO with 29 bits; the other services have base frames.
bool CobId::serves_extended() const {
  const bool of_pdo = rules_->use == CobIdUse::rpdo || rules_->use == CobIdUse::tpdo;
  return device_->described && of_pdo && (default_ & bit29) != 0;
}

// What a description may say and this node cannot do: another kind of identifier, or that of NMT commands.
bool CobId::cannot_be_served() const {
  return device_->described && (((value() & bit29) != 0 && !serves_extended()) || can_id() == 0);
}

bool CobId::extended() const { return serves_extended() && (value() & bit29) != 0; }

bool CobId::names(const conform::can::Frame& frame) const {
  return frame.id == can_id() && frame.extended == extended();
}

bool CobId::valid() const {
  const Entry* entry = device_->dictionary.entry(index_, sub_);
  if (entry == nullptr) return false;
  if (cannot_be_served()) return false;
  return rules_->valid(static_cast<std::uint32_t>(entry->number()));
}

// What cannot be produced is not, whatever a description begins with.
bool CobId::produced() const {
  if (device_->dictionary.entry(index_, sub_) == nullptr || !rules_->choices.produced) return false;
  if (cannot_be_served()) return false;
  return rules_->produced(value());
}

std::uint32_t CobId::can_id() const {
  if (extended()) return value() & extended_id_mask;
  const Entry* entry = device_->dictionary.entry(index_, sub_);
  const auto at_power_on =
      entry == nullptr ? default_ : static_cast<std::uint32_t>(conform::load_le(entry->default_value));
  return rules_->can_id(value(), at_power_on);
}

}  // namespace refnode
