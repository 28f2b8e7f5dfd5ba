// SPDX-License-Identifier: Apache-2.0
// A CAN bus on a virtual clock: discrete events, arbitration by CAN-ID, exact frame times, reproducible from
// a seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "can/participant.hpp"
#include "can/transport.hpp"

namespace conform::can {

/// Rules of the simulation:
///  - Every sender, the harness included, has one FIFO transmit queue, as a SocketCAN interface or a simple
///  CAN
///    controller has. Order inside a sender is kept (SDO segments rely on it); only the heads of the queues
///    arbitrate against each other, so a device can delay its own urgent frame as in reality.
///  - A frame occupies the wire for its exact stuffed length; all others receive it at the end of EOF, which
///  is its
///    stamp. The next frame starts three bits later at the earliest.
///  - Frames that a participant sends from inside on_frame() become ready after a turnaround drawn from the
///  seed;
///    frames from on_time() and attach() are ready at once, so that timers are exact.
///  - Two frames with the same arbitration field at the same time would collide on a real bus; here the
///  sender
///    attached first (the harness before all) wins.
///  - Every frame is acknowledged, as if a silent listener were always present.
class SimulatedBus {
 public:
  struct Options {
    std::uint32_t bit_rate = 500'000;  ///< bit/s, at least 1000
    std::uint64_t seed = 1;
    struct Turnaround {
      Duration least{std::chrono::microseconds(50)};
      Duration most{std::chrono::microseconds(150)};
    } node_turnaround{};
    std::size_t queue_limit = 4096;              ///< frames waiting in one sender
    std::uint32_t wakeup_budget = 1000;          ///< on_time() calls of one participant at one instant
    std::uint64_t silent_wakeups = 200'000'000;  ///< on_time() calls inside one receive()
  };

  SimulatedBus();
  explicit SimulatedBus(const Options& options);
  SimulatedBus(const SimulatedBus&) = delete;
  SimulatedBus& operator=(const SimulatedBus&) = delete;

  /// Connects a participant now. It must outlive the bus or be unplugged. `name` appears in errors.
  void attach(Participant& participant, std::string name = {});
  /// The harness's own access to the bus; time passes only in its receive().
  [[nodiscard]] Transport& transport() { return harness_; }
  [[nodiscard]] BusTime now() const { return now_; }
  /// Frames completed on the wire so far.
  [[nodiscard]] std::uint64_t frame_count() const { return frame_count_; }
  /// Frames a participant lost because its transmit queue was full, as a device with a full FIFO does.
  [[nodiscard]] std::uint64_t queue_overruns(const Participant& participant) const;

  // Faults, for tests. Frames are counted from 1 in the order they complete on the wire.

  /// Frame `number` reaches no receiver, though its sender believes so.
  void drop_frame(std::uint64_t number) { dropped_.push_back(number); }
  /// The harness's host loses frame `number`: counted in BusHealth::frames_dropped, never delivered to it.
  void drop_at_harness(std::uint64_t number) { dropped_at_harness_.push_back(number); }
  /// The participant disappears at `at` (now, if that is past), with its queue and the frame it is sending.
  void unplug(const Participant& participant, BusTime at = {});
  /// The harness's controller reports an error frame at `at`.
  void inject_error_frame(BusTime at, std::uint32_t error_class);
  /// From `at` on the harness's interface answers everything with this error.
  void break_harness(BusTime at, Error error);

 private:
  struct Pending {
    Frame frame;
    BusTime ready;
  };
  // A vector with a moving front: no allocation once warm.
  class Queue {
   public:
    [[nodiscard]] bool empty() const { return first_ == items_.size(); }
    [[nodiscard]] std::size_t size() const { return items_.size() - first_; }
    [[nodiscard]] const Pending& front() const { return items_[first_]; }
    [[nodiscard]] const Pending& back() const { return items_.back(); }
    void push(const Frame& frame, BusTime ready);
    void pop();
    void clear();

   private:
    std::vector<Pending> items_;
    std::size_t first_ = 0;
  };
  struct Node {
    Participant* participant = nullptr;  // nullptr: the harness, or unplugged
    std::string name;
    Queue queue;
    BusTime last_wakeup{};
    std::uint32_t wakeups_at_once = 0;
    std::uint64_t overruns = 0;
  };
  struct InFlight {
    Frame frame;
    std::size_t sender = 0;
    BusTime end;
  };
  struct Scheduled {
    BusTime at;
    std::size_t node = 0;  // to unplug, or 0 (harness)
    std::uint32_t error_class = 0;
    std::optional<Error> broken;
  };
  class Harness final : public Transport {
   public:
    explicit Harness(SimulatedBus& bus) : bus_(bus) {}
    [[nodiscard]] BusTime now() const override { return bus_.now_; }
    [[nodiscard]] Result<void> send(const Frame& frame) override;
    [[nodiscard]] Result<std::optional<BusEvent>> receive(BusTime deadline) override;
    [[nodiscard]] BusHealth health() override { return bus_.health_; }
    [[nodiscard]] TransportInfo info() const override;

   private:
    SimulatedBus& bus_;
  };

  void enqueue(std::size_t index, const Frame& frame);
  [[nodiscard]] Result<std::optional<BusEvent>> run_until(BusTime deadline);
  [[nodiscard]] std::optional<BusEvent> deliver();
  [[nodiscard]] std::optional<BusEvent> apply_scheduled();
  void start_frame();
  [[nodiscard]] Duration time_of(std::uint32_t bits) const;
  void wake(std::size_t index);
  void refresh_wakeups();
  void fault(const Node& node, const std::string& what);
  void set_wakeup(std::size_t index);
  void find_first_sleeper();
  [[nodiscard]] BusTime first_ready() const;
  [[nodiscard]] Duration turnaround();
  [[nodiscard]] std::size_t index_of(const Participant& participant) const;
  void schedule(Scheduled item);

  Options options_;
  std::uint64_t random_state_;
  Duration exact_bit_{};  ///< where a bit takes whole nanoseconds, as at all usual rates: no division then
  BusTime now_{};
  BusTime bus_free_{};
  std::vector<Node> nodes_;           // [0] is the harness
  std::vector<BusTime> wakeups_;      // per node, BusTime::max() for never
  std::size_t first_sleeper_ = 0;     // the one that wakes up first
  bool wakeups_stale_ = true;         // participants were called since next_wakeup() was asked
  std::vector<std::size_t> waiting_;  // nodes whose queue is not empty, in no order
  std::optional<InFlight> in_flight_;
  bool reacting_ = false;             // inside a participant's on_frame()
  std::optional<Duration> drawn_;     // turnaround of the on_frame() call being made
  std::vector<Scheduled> scheduled_;  // sorted by time
  std::vector<std::uint64_t> dropped_;
  std::vector<std::uint64_t> dropped_at_harness_;
  std::uint64_t frame_count_ = 0;
  std::optional<Error> error_;
  BusHealth health_;
  Harness harness_;
};

}  // namespace conform::can
