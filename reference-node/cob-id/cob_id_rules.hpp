// SPDX-License-Identifier: Apache-2.0
// What may be written to a COB-ID parameter, and what it then means on the bus (CiA 301, 7.3.5 and 7.5.2).
// The node knows base frames only, generates neither SYNC nor TIME, and refuses with 0609 0030h.
#pragma once

#include <cstdint>

#include "device/device.hpp"

namespace refnode {

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

class CobIdRules {
 public:
  CobIdRules(Device& device, CobIdUse use, std::uint16_t index, std::uint8_t sub,
             std::uint32_t default_value);

  /// Takes the entry's default over and lets its writes be checked; nothing when there is no such entry.
  void bind();
  [[nodiscard]] Accepted check(ByteView bytes) const;

  /// The communication object exists (SYNC and TIME: it is consumed).
  [[nodiscard]] bool valid() const;
  [[nodiscard]] std::uint32_t can_id() const;
  [[nodiscard]] bool remote_allowed() const;  ///< TPDO: bit 30 = 0

 private:
  [[nodiscard]] std::uint32_t value() const;
  [[nodiscard]] bool locked(std::uint32_t value) const;
  [[nodiscard]] bool active(std::uint32_t value) const;
  [[nodiscard]] const CobIdFaults& faults() const;
  [[nodiscard]] const CobIdChoices& choices() const;

  Device* device_;
  CobIdUse use_;
  std::uint16_t index_;
  std::uint8_t sub_;
  std::uint32_t default_;
};

/// Table 40 of CiA 301: CAN-IDs no configurable communication object may use.
[[nodiscard]] bool restricted_can_id(std::uint32_t id);

}  // namespace refnode
