// SPDX-License-Identifier: Apache-2.0
#include "cob-id/cob_id_rules.hpp"

namespace refnode {

namespace {

constexpr std::uint32_t bit31 = 0x80000000;  // EMCY, PDO, SDO: not valid; TIME: consume
constexpr std::uint32_t bit30 = 0x40000000;  // SYNC: generate; TIME: produce; EMCY: reserved; TPDO: no RTR
constexpr std::uint32_t bit29 = 0x20000000;  // 29-bit identifier
constexpr std::uint32_t can_id_mask = 0x000007FF;
constexpr std::uint32_t upper_id_bits = 0x1FFFF800;  // must be 0 with an 11-bit identifier

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

CobIdRules::CobIdRules(Device& device, CobIdUse use, std::uint16_t index, std::uint8_t sub,
                       std::uint32_t default_value)
    : device_(&device), use_(use), index_(index), sub_(sub), default_(default_value) {}

void CobIdRules::bind() {
  Entry* entry = device_->dictionary.entry(index_, sub_);
  if (entry == nullptr) return;
  default_ = static_cast<std::uint32_t>(conform::load_le(entry->default_value));
  entry->check = [rules = *this](ByteView bytes) { return rules.check(bytes); };
}

const CobIdFaults& CobIdRules::faults() const {
  switch (use_) {
    case CobIdUse::sync: return device_->behaviour.sync_cob_id;
    case CobIdUse::time: return device_->behaviour.time_cob_id;
    case CobIdUse::emergency: return device_->behaviour.emergency_cob_id;
    case CobIdUse::emergency_consumer: return device_->behaviour.emergency_consumer_cob_id;
    case CobIdUse::rpdo: return device_->behaviour.rpdo_cob_id;
    case CobIdUse::sdo_server: return device_->behaviour.sdo_server_cob_id;
    case CobIdUse::sdo_client: return device_->behaviour.sdo_client_cob_id;
    case CobIdUse::tpdo: break;
  }
  return device_->behaviour.tpdo_cob_id;
}

const CobIdChoices& CobIdRules::choices() const {
  switch (use_) {
    case CobIdUse::sync: return device_->choices.sync_cob_id;
    case CobIdUse::time: return device_->choices.time_cob_id;
    case CobIdUse::emergency: return device_->choices.emergency_cob_id;
    case CobIdUse::emergency_consumer: return device_->choices.emergency_consumer_cob_id;
    case CobIdUse::rpdo: return device_->choices.rpdo_cob_id;
    case CobIdUse::sdo_server:
    case CobIdUse::sdo_client: return device_->choices.sdo_cob_id;
    case CobIdUse::tpdo: break;
  }
  return device_->choices.tpdo_cob_id;
}

std::uint32_t CobIdRules::value() const {
  return static_cast<std::uint32_t>(device_->dictionary.number(index_, sub_, default_));
}

// While this holds before and after a write, bits 29-0 stay as they are. Taking the object out of use and
// moving it in one write is allowed: nothing was changed while it existed.
bool CobIdRules::locked(std::uint32_t value) const {
  switch (use_) {
    case CobIdUse::sync: return (value & bit30) != 0;
    case CobIdUse::time: return (value & (bit31 | bit30)) != 0;
    default: return (value & bit31) == 0;
  }
}

// SYNC and TIME have no bit that takes them out of use altogether: their CAN-ID is always looked at.
bool CobIdRules::active(std::uint32_t value) const {
  return use_ == CobIdUse::sync || use_ == CobIdUse::time || (value & bit31) == 0;
}

Accepted CobIdRules::check(ByteView bytes) const {
  const auto wanted = static_cast<std::uint32_t>(conform::load_le(bytes));
  const std::uint32_t present = value();
  const CobIdFaults& fault = faults();
  const CobIdChoices& choice = choices();

  if (wanted == present) return fault.rewrite_refused ? refuse(abort_code::invalid_value) : Accepted{};
  if ((wanted & bit29) != 0 && !fault.frame_bit_accepted) return refuse(choice.frame_bit);
  const bool bit30_refused = use_ == CobIdUse::sync || use_ == CobIdUse::time ||
                             use_ == CobIdUse::emergency || use_ == CobIdUse::emergency_consumer;
  if (bit30_refused && (wanted & bit30) != 0 && !fault.bit30_accepted) return refuse(choice.fixed_bit);
  const bool remote_refused = use_ == CobIdUse::tpdo && !device_->choices.tpdo.any_remote;
  if (remote_refused && (wanted & bit30) == 0) return refuse(choice.fixed_bit);
  if (use_ == CobIdUse::sync && (wanted & bit31) != 0 && fault.bit31_refused)
    return refuse(abort_code::invalid_value);
  if ((wanted & bit29) == 0 && (wanted & upper_id_bits) != 0 && !fault.upper_bits_accepted)
    return refuse(choice.upper_bits);
  const bool moved = ((wanted ^ present) & ~(bit31 | bit30)) != 0;
  if (moved && (fault.change_refused || choice.only_valid_bit)) return refuse(choice.locked);
  const bool lockable = locked(wanted) || choice.locked_by_former_value;
  if (moved && locked(present) && lockable && !fault.lock_missing) return refuse(choice.locked);
  // 000h in an entry that is not valid names no CAN-ID yet: the default of many of them (8000 0000h).
  const bool looked_at = active(wanted) || (choice.restricted_always && (wanted & can_id_mask) != 0);
  if (looked_at && restricted_can_id(wanted & can_id_mask) && !fault.restricted_accepted)
    return refuse(choice.restricted);
  return {};
}

bool CobIdRules::valid() const {
  if (device_->dictionary.entry(index_, sub_) == nullptr) return false;
  // What a description may say and this node cannot do: another kind of identifier, or that of NMT commands.
  if (device_->described && ((value() & bit29) != 0 || can_id() == 0)) return false;
  if (use_ == CobIdUse::sync) return true;
  const CobIdFaults& fault = faults();
  if (fault.valid_bit_ignored) return true;
  const bool set = (value() & bit31) != 0;
  const bool valid = use_ == CobIdUse::time ? set : !set;
  return fault.valid_bit_inverted ? !valid : valid;
}

std::uint32_t CobIdRules::can_id() const {
  return (faults().new_id_not_used ? default_ : value()) & can_id_mask;
}

bool CobIdRules::remote_allowed() const {
  return faults().remote_bit_ignored || ((value() & bit30) == 0) != faults().remote_bit_inverted;
}

}  // namespace refnode
