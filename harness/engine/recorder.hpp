// SPDX-License-Identifier: Apache-2.0
// The engine's hold on the bus: every event goes into the capture, due productions are sent, and a stop
// request ends waits.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "can/capture.hpp"
#include "can/transport.hpp"
#include "engine/observer.hpp"
#include "steps/session.hpp"

namespace conform::engine {

class Recorder {
 public:
  /// `stop` becomes non-zero (a signal number) when the user wants the run to end.
  /// `most_frames` bounds the capture: a node that floods the bus must not eat the host's memory.
  Recorder(can::Transport& transport, const std::atomic<int>* stop, std::size_t most_frames = 8'000'000)
      : transport_(transport),
        stop_(stop),
        most_frames_(most_frames),
        waits_in_slices_(stop != nullptr || !transport.info().is_virtual) {
    // On a kernel's socket, that is in real time, nobody may stand still while the capture moves to a larger
    // place.
    if (transport.info().receive_buffer > 0)
      capture_.reserve(std::min<std::size_t>(most_frames, std::size_t{1} << 20U));
    (void)now();
  }

  [[nodiscard]] BusTime now() const { return recent_ = transport_.now(); }
  [[nodiscard]] const can::Capture& capture() const { return capture_; }
  [[nodiscard]] can::Capture& capture() { return capture_; }
  [[nodiscard]] can::Transport& transport() { return transport_; }
  /// What happened now, as the comment of the next frame that is recorded.
  void mark_next_frame(std::string_view what) { mark_ = what; }
  /// Whether frames are told what they are part of; nobody pays for it whose capture is not kept.
  void tell_parts(bool tell) { tells_parts_ = tell; }
  [[nodiscard]] bool tells_parts() const { return tells_parts_; }
  /// A part of the run begins, and this is the comment of its first frame: of ours (productions in the
  /// background are no part of anything), or, where it sends nothing, of anybody. What was said of a part
  /// without frames is forgotten.
  enum class FirstFrame : std::uint8_t { ours, any };
  void begin_part(std::string comment, FirstFrame first = FirstFrame::ours);
  /// It is over; `words` continue the comment of its first frame, if it had one.
  void end_part(std::string_view words = {});
  /// Who is told of every frame; lives longer than this.
  void set_observer(Observer& observer) { observer_ = &observer; }
  [[nodiscard]] Observer& observer() { return *observer_; }

  /// Sends and waits for the echo. Its capture index: the frame was on the bus at its stamp.
  [[nodiscard]] Result<std::size_t> send(const can::Frame& frame);
  /// Hands one frame over and does not wait for its echo: for bursts. The caller bounds what is on its way.
  [[nodiscard]] Result<void> post(const can::Frame& frame);
  /// Receives at most one event not later than `deadline`. False: the deadline has passed on the bus.
  [[nodiscard]] Result<bool> listen(BusTime deadline) { return pump(deadline); }
  /// The fault of a frame whose echo never came.
  [[nodiscard]] std::unexpected<Error> never_sent();
  /// The host has lost frames, and the echo of `frame` was among them: the case will not be judged, but the
  /// run goes on as if the echo had come now. Capture index of the frame.
  std::size_t echo_lost(const can::Frame& frame);
  /// Whether the host has lost frames since the last `set_losses`. Asks the kernel and reads its counters, so
  /// not for every frame.
  [[nodiscard]] bool lost_frames() { return transport_.health().frames_dropped != losses_; }
  /// Frames lost until a case begins.
  void set_losses(std::uint64_t frames) { losses_ = frames; }
  /// First frame at or after `from` that matches and is stamped not after `deadline`; receives as long as
  /// that takes.
  [[nodiscard]] Result<std::optional<std::size_t>> find(std::size_t from, const steps::Session::Match& match,
                                                        BusTime deadline);
  [[nodiscard]] Result<void> wait_until(BusTime until);
  /// Index of the first frame that may be an effect of the frame of ours at `echo`. On some machines an
  /// answer overtakes the echo of its request; whatever was on the bus before the request is no answer.
  [[nodiscard]] std::size_t first_effect(std::size_t echo) const;

  void produce(steps::Production production);
  void stop_producing(std::string_view label);  ///< empty: everything
  void stop_producing_but_life_signs();
  /// Whether it may be one of those that are sent again and again.
  [[nodiscard]] bool is_produced(const can::Frame& frame) const;

  /// How late the host was since the last call.
  struct Lateness {
    Duration waking{};     ///< behind the end of a wait, or, from host_is_late on, with a frame of its own
    Duration producing{};  ///< behind the time at which a produced frame was due, where that is more than
                           ///< half its period
  };
  [[nodiscard]] Lateness take_lateness() { return std::exchange(lateness_, {}); }
  /// Frames of ours that were on the bus more than host_is_late behind the last thing that we had known
  /// before (productions are looked after above): whoever stands still in the middle of a sub-block finds a
  /// server that has lost patience.
  [[nodiscard]] std::uint64_t late_sendings() const { return late_sendings_; }

  /// A waking that was so late that the machine must have had other work.
  struct LateWaking {
    BusTime at;
    Duration by;  ///< more than machine_is_busy
  };
  [[nodiscard]] const std::optional<LateWaking>& latest_late_waking() const { return latest_late_waking_; }
  /// Timers of an idle machine are no later than that, also where the kernel counts in 10 ms.
  static constexpr Duration machine_is_busy = std::chrono::milliseconds(10);

  /// While restoring after a stop request the bus must still be usable.
  void ignore_stop(bool ignore) { ignore_stop_ = ignore; }
  /// The fault of the environment that ended the last wait or send, if any: tells it from mistakes of a
  /// scenario.
  [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }
  void clear_fault() { fault_.reset(); }
  void set_fault(Error fault) { fault_ = std::move(fault); }
  [[nodiscard]] bool stop_requested() const {
    return stop_ != nullptr && stop_->load() != 0 && !ignore_stop_;
  }

 private:
  struct Running {
    steps::Production production;
    BusTime due;
    std::uint64_t sent = 0;
  };
  /// Receives at most one event not later than `deadline`. False: the deadline has passed on the bus.
  [[nodiscard]] Result<bool> pump(BusTime deadline);
  [[nodiscard]] Result<void> produce_due();
  [[nodiscard]] std::unexpected<Error> broken(Error error);
  void woke(Duration late);
  void note_echo(const can::CapturedFrame& echo);
  /// For so long the bus had nothing to carry between `since` and the last frame, which is ours: what others
  /// send one behind the other keeps it waiting, and nobody is late.
  [[nodiscard]] Duration idle_before_last(BusTime since) const;
  void record(can::CapturedFrame frame);

  can::Transport& transport_;
  const std::atomic<int>* stop_;
  std::size_t most_frames_;
  std::uint64_t losses_ = 0;
  bool waits_in_slices_;  // virtual time needs no slices: only a real wait can be too long for the user
  // It was at least this late when we last knew. Reading the clock costs as much as sending a frame on some
  // machines.
  mutable BusTime recent_{};
  BusTime free_to_send_{};  ///< then we were at work for certain, and the frame before was gone
  std::uint64_t late_sendings_ = 0;
  bool ignore_stop_ = false;
  std::optional<Error> fault_;
  can::Capture capture_;
  std::string mark_;  ///< for the next frame
  struct Part {
    std::string comment;
    FirstFrame first = FirstFrame::ours;
    std::optional<std::size_t> frame{};  ///< capture index of the first one
  };
  std::optional<Part> part_;
  bool tells_parts_ = false;
  Observer nobody_;
  Observer* observer_ = &nobody_;
  std::vector<Running> running_;
  Lateness lateness_;
  std::optional<LateWaking> latest_late_waking_;
};

/// The Error::what of an ended wait, so that callers can tell it from a broken bus.
inline constexpr const char* stopped = "stopped by the user";
/// The Error::what of a flooded bus; it can still be used to put values back.
inline constexpr const char* flooded = "too many frames were recorded";

}  // namespace conform::engine
