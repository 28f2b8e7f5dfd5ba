// SPDX-License-Identifier: Apache-2.0
// The one way to a bus, simulated or real. Rules every implementation keeps (one contract test runs against
// all):
//  1. The transport owns the clock. Time passes only inside receive(); send() returns at once or fails after
//  a
//     small bound (full transmit queue).
//  2. Deadlines are absolute. A deadline in the past polls once; an event stamped *at* the deadline is
//  delivered.
//  3. Own frames come back, marked as transmitted, with the bus's stamp. A latency is the difference of two
//     stamps and never a clock read after waking up.
//  4. Error frames, dropped frames, bus-off, a vanished interface are reported as what they are, never as
//  silence.
//  5. Every loop has a budget.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/time.hpp"
#include "can/frame.hpp"

namespace conform::can {

enum class Direction : std::uint8_t { received, transmitted };

/// Something that happened on the bus, in the order of its stamps.
struct BusEvent {
  Frame frame;
  BusTime time;  ///< stamp of the bus: end of frame (simulated), kernel stamp (SocketCAN)
  Direction direction = Direction::received;
};

/// What could make a verdict untrustworthy, as counters since the transport was opened.
struct BusHealth {
  std::uint64_t frames_dropped = 0;    ///< frames the host lost on the way to us (socket buffer, backlog)
  std::uint64_t error_frames = 0;      ///< error frames seen
  std::uint64_t transmit_retries = 0;  ///< sends that found the transmit queue full at first
  bool bus_off = false;
  bool clock_stepped = false;  ///< the stamps' clock was set while we ran
  Duration worst_lateness{};   ///< longest time a received frame waited for us, own measurement
  // Counters, so that two snapshots tell what happened between them.
  std::uint64_t bus_offs = 0;  ///< times the controller went bus-off
  std::uint64_t outages = 0;   ///< times the bus was away and came back: nobody heard what passed meanwhile
  std::uint64_t clock_steps = 0;  ///< times the stamps' clock was set
  std::uint64_t late_frames = 0;  ///< received frames that waited for us longer than host_is_late
  /// Looks that found a frame of ours still in the interface, longer than host_is_late behind its echo.
  std::uint64_t transmit_stalls = 0;

  /// Whether frames may be missing, or have wrong stamps, since the snapshot `before`.
  [[nodiscard]] bool has_gap_since(const BusHealth& before) const {
    return frames_dropped > before.frames_dropped || bus_offs > before.bus_offs || outages > before.outages ||
           clock_steps > before.clock_steps || transmit_stalls > before.transmit_stalls;
  }
};

/// A host that looks at a frame, or wakes up, later than this may have done to the device what it then blames
/// the device for.
inline constexpr Duration host_is_late = std::chrono::milliseconds(100);

/// Facts about the bus that reports print.
struct TransportInfo {
  std::string name;                   ///< interface name, or "simulated"
  std::string driver;                 ///< "vcan", "kvaser_pci", ..., "simulated"
  bool is_virtual = true;             ///< no real machine can be at the other end (vcan, simulated)
  bool confirms_transmission = true;  ///< own frames come back after the wire, not before (IFF_ECHO)
  std::uint32_t bit_rate = 0;         ///< bit/s, 0 when unknown
  std::uint64_t receive_buffer = 0;   ///< bytes the kernel granted, 0 when unlimited
  std::int64_t epoch_ns = 0;          ///< UTC of BusTime 0, in ns since 1970-01-01
};

class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  virtual ~Transport() = default;

  [[nodiscard]] virtual BusTime now() const = 0;
  /// Hands one frame to the bus. Its echo (Direction::transmitted) arrives through receive().
  [[nodiscard]] virtual Result<void> send(const Frame& frame) = 0;
  /// The next event stamped not after `deadline`, or nullopt when the deadline has passed without one.
  [[nodiscard]] virtual Result<std::optional<BusEvent>> receive(BusTime deadline) = 0;
  /// After a failed send() or receive(): waits until the bus can be used again, as when a link is up again,
  /// an adapter is plugged in again or a controller was restarted, which somebody else does. True: it can.
  /// False: not until `deadline`. Error: it never will, whoever waits.
  [[nodiscard]] virtual Result<bool> come_back(BusTime deadline) {
    (void)deadline;
    return fail("the bus does not come back", info().name);
  }
  [[nodiscard]] virtual BusHealth health() = 0;
  [[nodiscard]] virtual TransportInfo info() const = 0;
};

}  // namespace conform::can
