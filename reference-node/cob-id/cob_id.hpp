// SPDX-License-Identifier: Apache-2.0
// What may be written to a COB-ID parameter, and what it then means on the bus (CiA 301, 7.3.5 and 7.5.2).
// The node knows base frames only, can produce SYNC and TIME, and refuses with 0609 0030h.
#pragma once

#include <cstdint>

#include "can/frame.hpp"
#include "device/device.hpp"
#include "rules/rule.hpp"

namespace refnode {

/// Whose COB-ID it is: the bits 31 and 30 mean something else with each.
enum class CobIdUse : std::uint8_t {
  sync,
  time,
  emergency,
  emergency_consumer,
  rpdo,
  tpdo,
  sdo_server,
  sdo_client
};

/// Table 40 of CiA 301: CAN-IDs no configurable communication object may use.
[[nodiscard]] bool restricted_can_id(std::uint32_t id);

/// Codes and freedoms of the COB-ID parameters of one use. CiA 301 names no code for most refusals.
struct CobIdChoices {
  AbortCode frame_bit = abort_code::invalid_value;   ///< bit 29 in a device with base frames only
  AbortCode fixed_bit = abort_code::invalid_value;   ///< bit 30: cannot be produced, or reserved
  AbortCode upper_bits = abort_code::invalid_value;  ///< bits 28-11 of a base frame
  AbortCode locked = abort_code::invalid_value;      ///< another CAN-ID while the object exists
  AbortCode restricted = abort_code::invalid_value;  ///< CiA 301, table 40
  bool only_valid_bit = false;                       ///< bit 31 can be changed, the CAN-ID cannot
  bool restricted_always = false;                    ///< refused while the object is not valid, too
  bool locked_by_former_value = false;               ///< switching off and moving in one write is refused
  bool remote_frames = true;                         ///< TPDO: without them bit 30 cannot be 0
  bool produced = true;                              ///< SYNC and TIME: otherwise bit 30 cannot be 1
};

/// The bits of the COB-ID parameters of one use. Each rule is given the whole value.
struct CobIdRules {
  explicit CobIdRules(CobIdUse use);

  CobIdUse use;
  CobIdChoices choices{};

  using Predicate = Rule<bool(std::uint32_t value)>;
  /// Bit 29: this device knows identifiers of 11 bits only.
  Predicate frame_bit_allowed;
  /// Bit 30 of EMCY is reserved.
  Predicate bit30_allowed;
  /// Bits 28-11 are 0 with an identifier of 11 bits.
  Predicate upper_bits_allowed;
  /// The communication object exists, so that bits 29-0 must not be changed.
  Predicate locked;
  Predicate restricted{restricted_can_id};  ///< given the CAN-ID alone
  /// The communication object exists (TIME: it is consumed). SYNC has no such bit.
  Predicate valid;
  Predicate remote_allowed;  ///< TPDO: bit 30 = 0
  Predicate produced;        ///< SYNC, TIME: bit 30 = 1
  /// The CAN-ID in use, of the value and that after power-on.
  Rule<std::uint32_t(std::uint32_t value, std::uint32_t at_power_on)> can_id;
};

/// One entry that holds a COB-ID.
class CobId {
 public:
  /// `rules` outlive the entry.
  CobId(Device& device, const CobIdRules& rules, std::uint16_t index, std::uint8_t sub,
        std::uint32_t default_value);

  /// Takes the entry's default over and lets its writes be checked; nothing when there is no such entry.
  void bind();
  [[nodiscard]] Accepted check(ByteView bytes) const;

  [[nodiscard]] bool valid() const;
  [[nodiscard]] std::uint32_t can_id() const;
  /// Its frames have 29 bits: that of a PDO of a twin, where the description begins with such an identifier.
  [[nodiscard]] bool extended() const;
  /// The frame has this CAN-ID, of as many bits.
  [[nodiscard]] bool names(const conform::can::Frame& frame) const;
  [[nodiscard]] bool remote_allowed() const { return rules_->remote_allowed(value()); }
  [[nodiscard]] bool produced() const;

 private:
  [[nodiscard]] std::uint32_t value() const;
  [[nodiscard]] bool serves_extended() const;
  [[nodiscard]] bool cannot_be_served() const;

  Device* device_;
  const CobIdRules* rules_;
  std::uint16_t index_;
  std::uint8_t sub_;
  std::uint32_t default_;
};

}  // namespace refnode
