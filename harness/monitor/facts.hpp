// SPDX-License-Identifier: Apache-2.0
// What the monitors may know beside the trace. All of it can be said on the command line of `judge` too, so
// that a recorded trace is judged like the run it came from.
#pragma once

#include <chrono>

#include "base/strong.hpp"
#include "base/time.hpp"

namespace conform::monitor {

struct Facts {
  NodeId node{1};
  Duration boot_time = std::chrono::seconds{5};        ///< T_BOOT
  Duration nmt_time = std::chrono::milliseconds{100};  ///< T_NMT
  /// So long after its boot-up message the device may miss an NMT command.
  Duration deaf_time = std::chrono::milliseconds{100};
  /// Nobody switches the power of the device unseen. A recorded trace does not tell.
  bool power_is_known = false;
  /// The trace tells which frames the host sent itself.
  bool senders_are_known = true;
  /// The device profile says that no other node is on the bus.
  bool alone = false;
};

}  // namespace conform::monitor
