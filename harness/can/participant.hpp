// SPDX-License-Identifier: Apache-2.0
// What takes part in a bus without owning it: frames and time are pushed in, frames leave through a sender.
// The same object runs on the simulated bus and, wrapped by a small loop, on a socket.
#pragma once

#include <functional>
#include <optional>

#include "base/time.hpp"
#include "can/frame.hpp"

namespace conform::can {

class Participant {
 public:
  using Sender = std::function<void(const Frame&)>;

  Participant() = default;
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;
  virtual ~Participant() = default;

  /// Called once before anything else. The sender may be called from inside any of the functions below.
  virtual void attach(Sender sender, BusTime now) = 0;
  /// A frame of another participant has been received completely at `now`.
  virtual void on_frame(const Frame& frame, BusTime now) = 0;
  /// A frame handed to the sender has left the transmit queue; called once for each, in their order, and
  /// never from inside the sender. On a socket the kernel's queue, which is short, counts as the wire. A
  /// frame that was lost on the way may stay without this call.
  virtual void on_transmitted(BusTime /*now*/) {}
  /// Time has reached next_wakeup(), or passed it.
  virtual void on_time(BusTime now) = 0;
  /// When on_time() is wanted next; nullopt: only frames matter.
  [[nodiscard]] virtual std::optional<BusTime> next_wakeup() const = 0;
};

}  // namespace conform::can
