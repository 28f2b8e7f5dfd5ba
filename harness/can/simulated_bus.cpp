// SPDX-License-Identifier: Apache-2.0
#include "can/simulated_bus.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "base/random.hpp"
#include "base/text.hpp"
#include "can/frame_time.hpp"

namespace conform::can {
namespace {

// Deadlines beyond this (146 years) would overflow the arithmetic of callers; nobody means them.
constexpr BusTime latest{Duration(std::int64_t{1} << 62U)};
constexpr BusTime never = BusTime::max();

}  // namespace

void SimulatedBus::Queue::push(const Frame& frame, BusTime ready) {
  if (first_ > 64 && first_ * 2 > items_.size()) {
    items_.erase(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(first_));
    first_ = 0;
  }
  items_.push_back({frame, ready});
}

void SimulatedBus::Queue::pop() {
  if (++first_ == items_.size()) clear();
}

void SimulatedBus::Queue::clear() {
  items_.clear();
  first_ = 0;
}

SimulatedBus::SimulatedBus() : SimulatedBus(Options{}) {}

SimulatedBus::SimulatedBus(const Options& options)
    : options_(options), random_state_(options.seed), harness_(*this) {
  CONFORM_CHECK(options_.bit_rate >= 1000);
  CONFORM_CHECK(options_.node_turnaround.least >= Duration::zero());
  CONFORM_CHECK(options_.node_turnaround.most >= options_.node_turnaround.least);
  if (1'000'000'000 % options_.bit_rate == 0) exact_bit_ = bit_time(1, options_.bit_rate);
  nodes_.emplace_back().name = "harness";
  wakeups_.push_back(never);
}

void SimulatedBus::attach(Participant& participant, std::string name) {
  const std::size_t index = nodes_.size();
  if (name.empty()) name = "participant " + std::to_string(index);
  Node& node = nodes_.emplace_back();
  node.participant = &participant;
  node.name = std::move(name);
  wakeups_.push_back(never);
  participant.attach([this, index](const Frame& frame) { enqueue(index, frame); }, now_);
  wakeups_stale_ = true;
}

std::size_t SimulatedBus::index_of(const Participant& participant) const {
  for (std::size_t i = 1; i < nodes_.size(); ++i) {
    if (nodes_[i].participant == &participant) return i;
  }
  return 0;
}

std::uint64_t SimulatedBus::queue_overruns(const Participant& participant) const {
  return nodes_[index_of(participant)].overruns;
}

void SimulatedBus::schedule(Scheduled item) {
  item.at = std::max(item.at, now_);
  const auto place = std::ranges::upper_bound(scheduled_, item.at, {}, &Scheduled::at);
  scheduled_.insert(place, std::move(item));
}

void SimulatedBus::unplug(const Participant& participant, BusTime at) {
  const std::size_t index = index_of(participant);
  if (index == 0) return;  // not attached, or gone already
  if (at > now_) {
    schedule({.at = at, .node = index, .error_class = 0, .broken = std::nullopt});
    return;
  }
  Node& node = nodes_[index];
  node.participant = nullptr;
  node.queue.clear();
  wakeups_[index] = never;
  wakeups_stale_ = true;
  std::erase(waiting_, index);
  // What it was sending is cut off: the receivers see an error and discard it, the wire is free again later.
  if (in_flight_ && in_flight_->sender == index) in_flight_.reset();
}

void SimulatedBus::inject_error_frame(BusTime at, std::uint32_t error_class) {
  schedule({.at = at, .node = 0, .error_class = error_class, .broken = std::nullopt});
}

void SimulatedBus::break_harness(BusTime at, Error error) {
  schedule({.at = at, .node = 0, .error_class = 0, .broken = std::move(error)});
}

Duration SimulatedBus::turnaround() {
  const auto least = options_.node_turnaround.least;
  const auto span = static_cast<std::uint64_t>((options_.node_turnaround.most - least).count());
  return least + Duration(static_cast<Duration::rep>(next_random(random_state_) % (span + 1U)));
}

void SimulatedBus::fault(const Node& node, const std::string& what) {
  if (!error_)
    error_ =
        Error{what, "simulated bus, " + node.name, "this is a fault of the simulated device, not of the bus"};
}

void SimulatedBus::enqueue(std::size_t index, const Frame& frame) {
  Node& node = nodes_[index];
  if (index != 0 && node.participant == nullptr) return;  // unplugged: nobody hears it
  if (frame.error) {
    fault(node, "tried to send an error frame; only controllers make them");
    return;
  }
  if (node.queue.size() >= options_.queue_limit) {
    ++node.overruns;
    return;
  }
  BusTime ready = now_;
  if (reacting_) {
    if (!drawn_) drawn_ = turnaround();
    ready += *drawn_;
  }
  if (!node.queue.empty()) ready = std::max(ready, node.queue.back().ready);
  if (node.queue.empty()) waiting_.push_back(index);
  node.queue.push(frame, ready);
}

void SimulatedBus::set_wakeup(std::size_t index) {
  const Participant* participant = nodes_[index].participant;
  wakeups_[index] = participant == nullptr ? never : participant->next_wakeup().value_or(never);
}

void SimulatedBus::refresh_wakeups() {
  for (std::size_t i = 1; i < nodes_.size(); ++i) set_wakeup(i);
  find_first_sleeper();
  wakeups_stale_ = false;
}

void SimulatedBus::find_first_sleeper() {
  BusTime first = wakeups_[0];
  first_sleeper_ = 0;
  for (std::size_t i = 1; i < wakeups_.size(); ++i) {
    if (wakeups_[i] >= first) continue;
    first = wakeups_[i];
    first_sleeper_ = i;
  }
}

BusTime SimulatedBus::first_ready() const {
  BusTime first = never;
  for (const std::size_t index : waiting_) first = std::min(first, nodes_[index].queue.front().ready);
  return first;
}

void SimulatedBus::wake(std::size_t index) {
  Node& node = nodes_[index];
  if (node.last_wakeup != now_) {
    node.last_wakeup = now_;
    node.wakeups_at_once = 0;
  }
  if (++node.wakeups_at_once > options_.wakeup_budget) {
    fault(node, "asked for " + std::to_string(options_.wakeup_budget) + " wake-ups at one instant (" +
                    to_string(now_.time_since_epoch()) + ") without letting time pass");
    return;
  }
  node.participant->on_time(now_);
  // The callback may have attached further participants: nodes_ may have moved.
  set_wakeup(index);
  find_first_sleeper();
}

Duration SimulatedBus::time_of(std::uint32_t bits) const {
  return exact_bit_ > Duration::zero() ? bits * exact_bit_ : bit_time(bits, options_.bit_rate);
}

// All heads that are ready take part in the arbitration; the smallest arbitration field wins, and of equal
// ones the sender attached first.
void SimulatedBus::start_frame() {
  std::size_t winner = nodes_.size();
  std::uint32_t best = 0;
  for (const std::size_t index : waiting_) {
    const Pending& head = nodes_[index].queue.front();
    if (head.ready > now_) continue;
    const std::uint32_t key = arbitration_key(head.frame);
    if (winner == nodes_.size() || key < best || (key == best && index < winner)) {
      winner = index;
      best = key;
    }
  }
  CONFORM_CHECK(winner < nodes_.size());
  Queue& queue = nodes_[winner].queue;
  const Frame frame = queue.front().frame;
  const std::uint32_t bits = frame_bits(frame);
  in_flight_ = InFlight{frame, winner, now_ + time_of(bits)};
  bus_free_ = now_ + time_of(bits + intermission_bits);
  queue.pop();
  if (queue.empty()) std::erase(waiting_, winner);
}

std::optional<BusEvent> SimulatedBus::deliver() {
  CONFORM_CHECK(in_flight_.has_value());
  const InFlight done = *in_flight_;
  in_flight_.reset();
  ++frame_count_;
  const bool own = done.sender == 0;
  const bool lost = !dropped_.empty() && std::ranges::find(dropped_, frame_count_) != dropped_.end();
  if (Participant* sender = nodes_[done.sender].participant) {
    sender->on_transmitted(now_);
    wakeups_stale_ = true;
  }
  if (!lost) {
    for (std::size_t i = 1; i < nodes_.size(); ++i) {
      Participant* participant = nodes_[i].participant;
      if (i == done.sender || participant == nullptr) continue;
      reacting_ = true;
      drawn_.reset();
      participant->on_frame(done.frame, now_);
      reacting_ = false;
    }
    wakeups_stale_ = true;
  }
  if (lost && !own) return std::nullopt;
  if (!dropped_at_harness_.empty() &&
      std::ranges::find(dropped_at_harness_, frame_count_) != dropped_at_harness_.end()) {
    ++health_.frames_dropped;
    return std::nullopt;
  }
  return BusEvent{done.frame, now_, own ? Direction::transmitted : Direction::received};
}

std::optional<BusEvent> SimulatedBus::apply_scheduled() {
  Scheduled item = std::move(scheduled_.front());
  scheduled_.erase(scheduled_.begin());
  if (item.broken) {
    error_ = std::move(item.broken);
  } else if (item.node != 0) {
    if (const Participant* participant = nodes_[item.node].participant) unplug(*participant, now_);
  } else {
    ++health_.error_frames;
    Frame frame;
    frame.id = item.error_class;
    frame.error = true;
    frame.dlc = 8;
    return BusEvent{frame, now_, Direction::received};
  }
  return std::nullopt;
}

Result<std::optional<BusEvent>> SimulatedBus::run_until(BusTime deadline) {
  if (deadline > latest) {
    return fail("the deadline lies beyond every real one", "simulated bus", "wait for a finite time");
  }
  deadline = std::max(deadline, now_);
  wakeups_stale_ = true;  // participants may have been changed from outside
  for (std::uint64_t wakeups = 0;;) {
    if (error_) return std::unexpected(*error_);
    if (wakeups_stale_) refresh_wakeups();
    // At one instant: scheduled faults, then the end of a frame, then timers, then the start of the next
    // frame, so that everything wanted by then takes part in its arbitration.
    const BusTime fault_at = scheduled_.empty() ? never : scheduled_.front().at;
    const BusTime end_at = in_flight_ ? in_flight_->end : never;
    const BusTime wake_at = wakeups_[first_sleeper_];
    BusTime start_at = in_flight_ ? never : first_ready();
    if (start_at != never) start_at = std::max(start_at, bus_free_);

    const BusTime next = std::max(std::min({fault_at, end_at, wake_at, start_at}), now_);
    if (next > deadline) {
      now_ = deadline;
      return std::nullopt;
    }
    now_ = next;
    if (fault_at <= next) {
      if (auto event = apply_scheduled()) return event;
    } else if (end_at <= next) {
      if (auto event = deliver()) return event;
    } else if (wake_at <= next) {
      const std::size_t sleeper = first_sleeper_;
      if (++wakeups > options_.silent_wakeups) {
        fault(nodes_[sleeper], "used up the budget of wake-ups while nothing happened on the bus");
      } else {
        wake(sleeper);
      }
    } else {
      start_frame();
    }
  }
}

Result<void> SimulatedBus::Harness::send(const Frame& frame) {
  if (bus_.error_) return std::unexpected(*bus_.error_);
  if (frame.error) return fail("error frames are made by the controller and cannot be sent", "simulated bus");
  if (bus_.nodes_[0].queue.size() >= bus_.options_.queue_limit) {
    ++bus_.health_.transmit_retries;
    return fail("the transmit queue is full", "simulated bus",
                "receive between sends, so that time can pass");
  }
  bus_.enqueue(0, frame);
  return {};
}

Result<std::optional<BusEvent>> SimulatedBus::Harness::receive(BusTime deadline) {
  return bus_.run_until(deadline);
}

TransportInfo SimulatedBus::Harness::info() const {
  TransportInfo info;
  info.name = "simulated";
  info.driver = "simulated";
  info.bit_rate = bus_.options_.bit_rate;
  return info;
}

}  // namespace conform::can
