// SPDX-License-Identifier: Apache-2.0
#include "can/socket_loop.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "can/socketcan_transport.hpp"

namespace conform::can {
namespace {

// on_time() calls for one reading of the clock; more means that the participant makes no progress.
constexpr int wakeup_budget = 1000;
// Without a timer the loop still comes round now and then: a transport without wake descriptor must notice
// the flag.
constexpr Duration longest_wait = std::chrono::seconds(1);

}  // namespace

StopFlag::StopFlag() : descriptor_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

void StopFlag::request() noexcept {
  requested_.store(true, std::memory_order_relaxed);
  ring();
}

void StopFlag::wake() noexcept {
  woken_.store(true, std::memory_order_relaxed);
  ring();
}

void StopFlag::ring() noexcept {
  const int saved = errno;
  const std::uint64_t one = 1;
  // Fails only when the counter is full, and then the descriptor is readable anyway.
  [[maybe_unused]] const auto written = ::write(descriptor_.get(), &one, sizeof one);
  errno = saved;
}

void StopFlag::heard() const noexcept {
  if (!woken_.exchange(false, std::memory_order_relaxed)) return;
  std::uint64_t rings = 0;
  [[maybe_unused]] const auto count = ::read(descriptor_.get(), &rings, sizeof rings);
}

Result<LoopStatistics> run_participant(Participant& participant, Transport& transport, const StopFlag& stop,
                                       const OnOutage& on_outage) {
  LoopStatistics statistics;
  std::optional<Error> outage;  // as long as it lasts
  BusTime current = transport.now();
  std::uint64_t unconfirmed = 0;
  participant.attach(
      [&](const Frame& frame) {
        // A device goes on when a frame of its cannot be sent; a broken interface shows in receive() below.
        ++unconfirmed;
        if (transport.send(frame)) {
          ++statistics.sent;
        } else {
          ++statistics.not_sent;
        }
      },
      current);

  bool stamped = false;
  while (!stop.requested()) {
    stop.heard();
    // The stamp of a frame that has just come is as good as the clock, and reading it costs nothing.
    if (!stamped) current = std::max(current, transport.now());
    stamped = false;
    int wakeups = 0;
    std::optional<BusTime> wakeup = participant.next_wakeup();
    while (wakeup && *wakeup <= current) {
      if (++wakeups > wakeup_budget) {
        return fail("the device asked for " + std::to_string(wakeup_budget) +
                        " wake-ups at one instant without letting time pass",
                    transport.info().name);
      }
      participant.on_time(current);
      wakeup = participant.next_wakeup();
    }
    // Who sends on being confirmed must not keep the loop from receiving: look for a frame after each round.
    if (unconfirmed > 0) {
      for (auto count = std::exchange(unconfirmed, 0); count > 0; --count)
        participant.on_transmitted(current);
      wakeup = participant.next_wakeup();
    }
    BusTime deadline = std::min(wakeup.value_or(BusTime::max()), current + longest_wait);
    if (unconfirmed > 0) deadline = current;
    if (outage) {
      // A device does not end with its bus, and its timers do not stand still.
      const auto back = transport.come_back(deadline);
      if (!back) return std::unexpected(*outage);
      if (!*back) continue;
      outage.reset();
      if (on_outage) on_outage(std::nullopt);
    }
    const auto received = transport.receive(deadline);
    if (!received) {
      if (!outage && on_outage) on_outage(received.error());
      outage = received.error();
      continue;
    }
    const std::optional<BusEvent>& event = *received;
    if (!event || event->direction == Direction::transmitted || event->frame.error) continue;
    current = std::max(current, event->time);
    stamped = true;
    ++statistics.received;
    participant.on_frame(event->frame, current);
  }
  return statistics;
}

Result<LoopStatistics> run_on_interface(Participant& participant, const std::string& interface_name,
                                        const StopFlag& stop, const OnOutage& on_outage) {
  SocketCanOptions options;
  options.receive_own = false;
  options.wake_descriptor = stop.descriptor();
  options.send_bound = std::chrono::milliseconds(100);
  const auto transport = SocketCanTransport::open(interface_name, options);
  if (!transport) return std::unexpected(transport.error());
  return run_participant(participant, **transport, stop, on_outage);
}

}  // namespace conform::can
