// SPDX-License-Identifier: Apache-2.0
// Runs one participant on a real or virtual CAN interface: what the reference node's main() does.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "can/descriptor.hpp"
#include "can/participant.hpp"
#include "can/transport.hpp"

namespace conform::can {

/// A request to stop, or to come round, that a signal handler may make and that wakes up a waiting loop.
class StopFlag {
 public:
  StopFlag();
  /// Async-signal-safe.
  void request() noexcept;
  [[nodiscard]] bool requested() const noexcept { return requested_.load(std::memory_order_relaxed); }
  /// Async-signal-safe: the loop asks the participant for its next wake-up now, and goes on.
  void wake() noexcept;
  /// The loop has come round.
  void heard() const noexcept;
  /// Readable once stopping or coming round was requested.
  [[nodiscard]] int descriptor() const noexcept { return descriptor_.get(); }

 private:
  void ring() noexcept;

  static_assert(std::atomic<bool>::is_always_lock_free);
  std::atomic<bool> requested_{false};
  mutable std::atomic<bool> woken_{false};
  Descriptor descriptor_;
};

struct LoopStatistics {
  std::uint64_t received = 0;
  std::uint64_t sent = 0;
  std::uint64_t not_sent = 0;  ///< the transmit queue stayed full or the bus was not there
};

/// Told when the bus goes away (the fault), and when it is back (nothing).
using OnOutage = std::function<void(const std::optional<Error>&)>;

/// Feeds the participant from `transport` until stopped (no error). A bus that goes away is waited for, while
/// the participant's timers go on; one that cannot come back is the error. The transport should have been
/// opened with the flag's descriptor as wake descriptor, else stopping waits for the next frame or timer.
/// Time never goes back for the participant; frames carry their stamps.
[[nodiscard]] Result<LoopStatistics> run_participant(Participant& participant, Transport& transport,
                                                     const StopFlag& stop, const OnOutage& on_outage = {});

/// Opens the interface and runs the participant on it.
[[nodiscard]] Result<LoopStatistics> run_on_interface(Participant& participant,
                                                      const std::string& interface_name, const StopFlag& stop,
                                                      const OnOutage& on_outage = {});

}  // namespace conform::can
