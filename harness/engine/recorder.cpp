// SPDX-License-Identifier: Apache-2.0
#include "engine/recorder.hpp"

#include <algorithm>
#include <chrono>

namespace conform::engine {
namespace {

using namespace std::chrono_literals;

/// A stop request is answered within this time: no new request goes out later than that.
constexpr Duration stop_latency = 40ms;
/// A frame that is not on the bus by then will not be: bus-off, no acknowledging node, stuck queue.
constexpr Duration transmit_limit = 1s;
/// Echo and answer that are fetched from the controller together get stamps this close. On the bus an answer
/// needs longer.
constexpr Duration overtaking = 20us;

}  // namespace

std::unexpected<Error> Recorder::broken(Error error) {
  fault_ = error;
  return std::unexpected(std::move(error));
}

Result<bool> Recorder::pump(BusTime deadline) {
  if (stop_requested()) return broken({stopped, {}, {}});
  if (capture_.size() >= most_frames_ && !ignore_stop_) {
    return broken({flooded, transport_.info().name,
                   "does a node flood the bus? A run records " + std::to_string(most_frames_) + " frames"});
  }
  auto until = deadline;
  for (const auto& running : running_) until = std::min(until, running.due);
  if (waits_in_slices_) until = std::min(until, recent_ + stop_latency);
  const bool is_ahead = until > recent_;
  auto event = transport_.receive(until);
  if (!event) return broken(event.error());
  if (*event) {
    recent_ = std::max(recent_, (**event).time);
    record({(**event).frame, (**event).time, (**event).direction, {}});
    return true;
  }
  if (is_ahead) woke(now() - until);
  auto produced = produce_due();
  if (!produced) return std::unexpected(produced.error());
  // Whatever the clock says: behind the end of a slice nobody has looked yet. A host that stood still finds
  // there what came meanwhile.
  const bool goes_on = now() < deadline || until < deadline;
  observer_->waited(recent_);
  return goes_on;
}

void Recorder::record(can::CapturedFrame frame) {
  capture_.add(std::move(frame));
  const auto index = capture_.size() - 1;
  if (!mark_.empty()) capture_.comment(index, std::exchange(mark_, {}));
  if (part_ && !part_->frame) {
    const auto& captured = capture_.frames()[index];
    const bool ours = captured.direction == can::Direction::transmitted && !is_produced(captured.frame);
    if (ours || part_->first == FirstFrame::any) {
      capture_.comment(index, part_->comment);
      part_->frame = index;
    }
  }
  const auto& recorded = capture_.frames().back();
  if (recorded.direction == can::Direction::transmitted) note_echo(recorded);
  observer_->recorded(recorded);
}

void Recorder::note_echo(const can::CapturedFrame& echo) {
  const auto since = std::exchange(free_to_send_, std::max(free_to_send_, echo.time));
  if (echo.time - since <= can::host_is_late) return;
  const auto late = idle_before_last(since);
  if (late <= can::host_is_late) return;
  ++late_sendings_;
  woke(late);
}

Duration Recorder::idle_before_last(BusTime since) const {
  // A long frame at 125 kbit/s takes 1.1 ms; at lower bit rates more, and then it is known.
  const auto rate = transport_.info().bit_rate;
  const Duration frame =
      rate == 0 ? Duration(std::chrono::milliseconds(2)) : Duration(std::chrono::seconds(200)) / rate;
  Duration idle{};
  const auto& frames = capture_.frames();
  for (auto i = frames.size() - 1; i > 0 && frames[i].time > since; --i) {
    const auto gap = frames[i].time - std::max(frames[i - 1].time, since);
    if (gap > frame) idle += gap;
  }
  return idle;
}

bool Recorder::is_produced(const can::Frame& frame) const {
  return std::ranges::any_of(running_, [&frame](const Running& running) {
    auto produced = running.production.frame;
    if (running.production.counts_to) produced.data[0] = frame.data[0];
    return produced == frame;
  });
}

void Recorder::begin_part(std::string comment, FirstFrame first) {
  if (tells_parts_) part_ = Part{std::move(comment), first};
}

void Recorder::end_part(std::string_view words) {
  if (part_ && part_->frame && !words.empty())
    capture_.continue_comment(*part_->frame, part_->comment, ": " + std::string(words));
  part_.reset();
}

void Recorder::woke(Duration late) {
  lateness_.waking = std::max(lateness_.waking, late);
  if (late > machine_is_busy) latest_late_waking_ = {recent_, late};
}

Result<void> Recorder::produce_due() {
  for (auto& running : running_) {
    const auto current = now();
    if (running.due > current) continue;
    // The first one begins the train; only what follows has a time at which it is due.
    const Duration late = current - running.due;
    if (running.production.keeps_time && running.sent > 0 && late > running.production.every / 2)
      lateness_.producing = std::max(lateness_.producing, late);
    free_to_send_ = std::max(free_to_send_, current);
    auto& frame = running.production.frame;
    if (const auto last = running.production.counts_to)
      frame.data[0] = static_cast<std::uint8_t>(running.sent % *last + 1);
    auto sent = transport_.send(frame);
    if (!sent) return broken(sent.error());
    ++running.sent;
    running.due += running.production.every;
    // After a pause of the host the train goes on from now; a burst would be no heartbeat.
    if (running.due <= now()) running.due = now() + running.production.every;
  }
  std::erase_if(running_, [](const Running& running) {
    return running.production.count && running.sent >= *running.production.count;
  });
  return {};
}

Result<std::size_t> Recorder::send(const can::Frame& frame) {
  const auto from = capture_.size();
  if (auto sent = post(frame); !sent) return std::unexpected(sent.error());
  const auto is_echo = [&frame](const can::CapturedFrame& captured) {
    return captured.direction == can::Direction::transmitted && captured.frame == frame;
  };
  // Nearly always the echo is there at once; only when it is not, the exact time matters.
  auto echo = find(from, is_echo, recent_ + transmit_limit);
  if (echo && !*echo) echo = find(from, is_echo, now() + transmit_limit);
  if (!echo) return std::unexpected(echo.error());
  if (*echo) return **echo;
  if (!lost_frames()) return never_sent();
  return echo_lost(frame);
}

Result<void> Recorder::post(const can::Frame& frame) {
  if (stop_requested()) return broken({stopped, {}, {}});
  free_to_send_ = std::max(free_to_send_, recent_);
  auto sent = transport_.send(frame);
  if (!sent) return broken(sent.error());
  return {};
}

std::size_t Recorder::echo_lost(const can::Frame& frame) {
  record({frame, recent_, can::Direction::transmitted, "sent; the host lost its echo"});
  return capture_.size() - 1;
}

std::unexpected<Error> Recorder::never_sent() {
  return broken({"a frame was not transmitted within 1 s", transport_.info().name,
                 "is another node on the bus to acknowledge it, and the bit rate right?"});
}

Result<std::optional<std::size_t>> Recorder::find(std::size_t from, const steps::Session::Match& match,
                                                  BusTime deadline) {
  for (std::size_t i = from;; ++i) {
    while (i >= capture_.size()) {
      const auto size = capture_.size();
      auto more = pump(deadline);
      if (!more) return std::unexpected(more.error());
      if (!*more && capture_.size() == size) return std::optional<std::size_t>();
    }
    const auto& captured = capture_.frames()[i];
    if (captured.time > deadline) return std::optional<std::size_t>();
    if (match(captured)) return std::optional(i);
  }
}

std::size_t Recorder::first_effect(std::size_t echo) const {
  const auto& frames = capture_.frames();
  auto first = echo;
  while (first > 0 && frames[first - 1].direction == can::Direction::received &&
         frames[first - 1].time + overtaking > frames[echo].time)
    --first;
  return first;
}

Result<void> Recorder::wait_until(BusTime until) {
  // Until the bus says that it is over: frames of the wait that were not looked at yet belong to the wait.
  while (true) {
    auto more = pump(until);
    if (!more) return std::unexpected(more.error());
    if (!*more) return {};
  }
}

void Recorder::produce(steps::Production production) {
  stop_producing(production.label);
  running_.push_back({std::move(production), now(), 0});
}

void Recorder::stop_producing(std::string_view label) {
  std::erase_if(running_, [label](const Running& running) {
    return label.empty() || running.production.label == label;
  });
}

void Recorder::stop_producing_but_life_signs() {
  std::erase_if(running_, [](const Running& running) { return !running.production.life_sign; });
}

}  // namespace conform::engine
