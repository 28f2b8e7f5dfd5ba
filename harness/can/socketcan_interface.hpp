// SPDX-License-Identifier: Apache-2.0
// What the kernel tells about a CAN interface, and what to type when something is wrong with it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace conform::can {

struct InterfaceFacts {
  std::string name;
  int index = 0;
  std::string kind;    ///< rtnetlink kind: "vcan", "vxcan", "can" (hardware, slcan)
  std::string driver;  ///< kernel driver of the hardware, else the kind
  bool up = false;     ///< administratively up
  bool echo = false;   ///< IFF_ECHO: the driver returns own frames after the wire has seen them
  /// No wire can be at the other end: a vcan whose frames no gateway job (cangw) sends on. The other end of a
  /// vxcan is in a namespace that we do not see.
  bool is_virtual = false;
  std::string routed_to;  ///< of a vcan: the interface that a gateway job passes its frames to
  bool bus_off = false;
  std::uint32_t bit_rate = 0;      ///< bit/s, 0 for virtual interfaces
  std::uint32_t sample_point = 0;  ///< in 1/1000 of a bit, 0 where there is none
  std::uint32_t queue_length = 0;  ///< frames that the transmit queue of the interface holds
  std::string state;               ///< of the controller: "error-active", "bus-off"; empty: it has none
  struct ErrorCounters {
    std::uint16_t transmit = 0, receive = 0;
  };
  std::optional<ErrorCounters> errors{};  ///< where the controller tells them
};

/// Facts about the interface, whatever its state. Fails when it is missing or not CAN.
[[nodiscard]] Result<InterfaceFacts> interface_facts(const std::string& name);

/// Facts about an interface that is ready for use. Missing, not CAN, down, bus-off or a kernel without CAN is
/// an error whose hint is the command to type.
[[nodiscard]] Result<InterfaceFacts> preflight(const std::string& interface_name);

/// Names of all CAN interfaces, sorted.
[[nodiscard]] std::vector<std::string> can_interfaces();

/// The command that brings this interface up: "sudo ip link set can0 up type can bitrate 500000".
[[nodiscard]] std::string up_command(const std::string& name, const std::string& kind);

}  // namespace conform::can
