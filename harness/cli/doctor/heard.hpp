// SPDX-License-Identifier: Apache-2.0
// Who is on a bus, by what is heard of them.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "base/error.hpp"
#include "base/strong.hpp"
#include "base/time.hpp"
#include "can/transport.hpp"

namespace conform::cli {

/// What one node sent, by the CAN-IDs of the pre-defined connection set (CiA 301, 7.3.5).
struct HeardNode {
  std::size_t boot_ups = 0, heartbeats = 0, emcys = 0, pdos = 0;
  std::optional<std::uint8_t>
      state{};  ///< of its latest heartbeat or guarding answer, without the toggle bit
  std::optional<std::uint32_t> device_type{};  ///< 1000h, where it was asked
  bool answers = false;                        ///< it sent SDO responses
  std::optional<BusTime> last_beat{};
  std::optional<Duration> longest_period{};  ///< between heartbeats
};

struct Heard {
  std::map<std::uint8_t, HeardNode> nodes;
  std::size_t frames = 0;
  Duration listened{};
  // What only masters and tools send.
  std::size_t nmt_commands = 0, sdo_requests = 0, lss_requests = 0, guard_requests = 0;
  std::size_t syncs = 0, times = 0;
  std::size_t others = 0;  ///< extended identifiers, and CAN-IDs of no service
  // Error frames of the controller, by what they tell; one may tell several things.
  std::size_t not_acknowledged = 0, violated = 0, bus_off = 0;

  [[nodiscard]] bool is_disturbed() const { return violated + not_acknowledged + bus_off > 0; }
};

/// Adds one event that somebody else caused.
void note(Heard& heard, const can::BusEvent& event);

/// Listens so long, and sends nothing. Ends early when `stop` is not 0. Error: the interface failed.
[[nodiscard]] Result<void> listen(can::Transport& transport, Duration time, const std::atomic<int>& stop,
                                  Heard& heard);

/// Asks every node-ID for 1000h, one after the other, each `patience` at most: reads only.
[[nodiscard]] Result<void> ask_everybody(can::Transport& transport, Duration patience,
                                         const std::atomic<int>& stop, Heard& heard);

}  // namespace conform::cli
