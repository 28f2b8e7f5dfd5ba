// SPDX-License-Identifier: Apache-2.0
// The NMT states, the services, and which of them works in which state (CiA 301, 7.3.2.2.5).
#pragma once

#include <cstdint>

namespace refnode {

enum class NmtState : std::uint8_t {
  initialising = 0x00,
  stopped = 0x04,
  operational = 0x05,
  pre_operational = 0x7F
};

enum class Service : std::uint8_t {
  boot_up,
  heartbeat,
  guarding,
  emergency,
  sdo,
  sync,
  time,
  rpdo,
  tpdo,
  lss
};

/// Table 38: PDOs in Operational; SDO, SYNC, TIME and EMCY there and in Pre-operational; error control in
/// these and in Stopped, and LSS (CiA 305) as well. Before the boot-up message nothing but that.
[[nodiscard]] constexpr bool works_in(Service service, NmtState state) {
  switch (state) {
    case NmtState::initialising: return service == Service::boot_up;
    case NmtState::stopped:
      return service == Service::heartbeat || service == Service::guarding || service == Service::lss;
    case NmtState::pre_operational: return service != Service::rpdo && service != Service::tpdo;
    case NmtState::operational: return true;
  }
  return false;
}

}  // namespace refnode
