// SPDX-License-Identifier: Apache-2.0
#include "cli/replay/player.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "can/capture_marks.hpp"
#include "can/frame_time.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/sdo_initiate.hpp"
#include "cli/replay/block_answer.hpp"
#include "cli/replay/open_transfers.hpp"
#include "cli/replay/stamps.hpp"
#include "engine/run_context.hpp"

namespace conform::cli {
namespace {

using can::Direction;

/// The command specifier of a server: bits 7 to 5.
constexpr unsigned command_bits = 0x20;

/// An abort is not answered; a server that does it all the same does so within this time.
constexpr Duration rest_after_abort = std::chrono::milliseconds(20);

class Player {
 public:
  Player(engine::Recorder& recorder, const Side& side, const device::Profile& profile,
         const std::function<Result<void>()>& power)
      : recorder_(recorder),
        side_(side),
        frames_(side.frames),
        recorded_(side.dialogue),
        times_(side.frames, side.first, side.end),
        profile_(profile),
        power_(power),
        bit_rate_(recorder.transport().info().bit_rate),
        state_(side.dialogue.sent.size()),
        told_(side.first),
        followed_(recorder.capture().size()),
        heard_(followed_) {}

  Result<Played> run() {
    auto out = play();
    if (!out) return std::unexpected(stopped(out.error()));
    // What comes behind the end of the section may be a part of a transfer only.
    const auto aborted = abort_open();
    if (!aborted) return std::unexpected(aborted.error());
    if (!aborted->empty())
      notes_.push_back("these frames end within a transfer, which was aborted behind them: " + *aborted);
    out->skipped = std::move(skipped_);
    out->aborts = std::move(aborts_);
    out->notes = std::move(notes_);
    return out;
  }

 private:
  Result<Played> play() {
    Played out;
    out.first = recorder_.capture().size();
    now_ = recorder_.now();
    then_ = times_.at(side_.first);
    for (; turn_ < recorded_.turns.size(); ++turn_) {
      const auto& turn = recorded_.turns[turn_];
      const auto index =
          turn.answer ? recorded_.sent[turn.sent].answers[*turn.answer] : recorded_.sent[turn.sent].index;
      if (auto switched = switch_power(index); !switched) return std::unexpected(switched.error());
      auto done = turn.answer ? await(turn) : send(turn.sent);
      if (!done) return std::unexpected(done.error());
    }
    if (auto switched = switch_power(side_.end); !switched) return std::unexpected(switched.error());
    // What came behind the last frame of the section was not recorded with it: an answer that is one too many
    // may stand among the frames of the next case.
    const auto tail = gap_to(side_.end - 1);
    if (auto done = recorder_.wait_until(now_ + tail); !done) return std::unexpected(done.error());
    out.recorded_end = out.end = recorder_.capture().size();
    if (out.end > out.first) note(out.end - 1, side_.end - 1);
    if (last_was_ignored() && tail < profile_.quiet_time) {
      if (auto done = recorder_.wait_until(now_ + profile_.quiet_time); !done)
        return std::unexpected(done.error());
      out.end = recorder_.capture().size();
    }
    return out;
  }

  struct State {
    std::size_t next = 0;  ///< capture index from which on its next answer is looked for
    bool over = false;     ///< nothing more is waited for
    BusTime latest{};      ///< it, or its latest answer
  };

  Result<void> send(std::size_t number) {
    const auto index = recorded_.sent[number].index;
    const auto& captured = frames_[index];
    const bool is_segment = side_.is_block_segment(index);
    const auto kind = answer_of(captured.frame, profile_.node);
    const bool is_request = kind && kind->of == AnswerKind::Of::sdo;
    if (is_segment && has_left_) return skip(number);
    if (given_up_ == captured.frame.id) {
      if (is_segment || !begins_anew(captured.frame)) return skip(number);
      given_up_.reset();
    }
    if (!is_segment && is_request) has_left_ = false;
    auto due = now_ + gap_to(index);
    // Stamps are of the end of a frame.
    if (bit_rate_ > 0) due -= can::bit_time(can::frame_bits(captured.frame), bit_rate_);
    if (due > recorder_.now()) {
      if (auto waited = recorder_.wait_until(due); !waited) return waited;
    }
    if (is_request) {
      const auto in_step = is_segment ? stays_in_step(number, *kind) : stays_out_of_blocks(number);
      if (!in_step) return std::unexpected(in_step.error());
      if (!*in_step) return skip(number);
    }
    const auto before = recorder_.capture().size();
    const auto echo = recorder_.send(captured.frame);
    if (!echo) {
      // It may be on its way.
      open_.sent(captured.frame);
      under_way_ = before;
      return std::unexpected(echo.error());
    }
    next_ = number + 1;
    note(*echo, index);
    follow(recorder_.first_effect(*echo));
    open_.sent(captured.frame);
    if (is_request && !is_segment) heard_ = followed_;
    now_ = recorder_.capture().frames()[*echo].time;
    then_ = times_.at(index);
    state_[number] = {recorder_.first_effect(*echo), false, now_};
    return {};
  }

  Result<void> skip(std::size_t number) {
    skipped_.push_back(number);
    state_[number].over = true;
    next_ = number + 1;
    return {};
  }

  // Takes in what was received before this index of the new capture; what was sent is told where it is sent.
  void follow(std::size_t end) {
    for (; followed_ < end; ++followed_) {
      const auto& captured = recorder_.capture().frames()[followed_];
      if (captured.direction == Direction::received) open_.received(captured.frame);
    }
  }

  /// Whether a segment of a block download may go out: the server takes it, and has said nothing that it did
  /// not say then.
  Result<bool> stays_in_step(std::size_t number, const AnswerKind& kind) {
    follow(recorder_.capture().size());
    const auto& frames = recorder_.capture().frames();
    for (; heard_ < frames.size(); ++heard_) {
      if (frames[heard_].direction != Direction::received || !is_answer(frames[heard_].frame, kind)) continue;
      const auto due = next_answer(kind);
      if (!due || is_abort(frames[heard_].frame)) continue;
      const auto why = why_out_of_step(*due, frames[heard_].frame, true);
      if (why.empty()) continue;
      if (auto done = give_up(number, why); !done) return std::unexpected(done.error());
      return false;
    }
    const bool takes = open_.takes_segments(frames_[recorded_.sent[number].index].frame.id);
    has_left_ = has_left_ || !takes;
    return takes;
  }

  /// Whether any other request may go out: a server that is in a block download, and was not then, would take
  /// it for a segment.
  Result<bool> stays_out_of_blocks(std::size_t number) {
    const auto& frame = frames_[recorded_.sent[number].index].frame;
    follow(recorder_.capture().size());
    if (is_abort(frame) || !open_.takes_segments(frame.id)) return true;
    if (auto done = give_up(number, "the device takes segments, and did not then"); !done)
      return std::unexpected(done.error());
    if (!begins_anew(frame)) return false;
    given_up_.reset();
    return true;
  }

  /// The answer of this kind that comes next in the old capture.
  [[nodiscard]] const can::Frame* next_answer(const AnswerKind& kind) const {
    for (auto i = turn_; i < recorded_.turns.size(); ++i) {
      const auto& turn = recorded_.turns[i];
      const auto& sent = recorded_.sent[turn.sent];
      if (turn.answer && answer_of(frames_[sent.index].frame, profile_.node) == kind)
        return &frames_[sent.answers[*turn.answer]].frame;
    }
    return nullptr;
  }

  /// Whether the next frame on the channel of this one is a segment of a block download.
  [[nodiscard]] bool segments_follow(std::size_t number) const {
    const auto id = frames_[recorded_.sent[number].index].frame.id;
    for (auto i = number + 1; i < recorded_.sent.size(); ++i) {
      const auto index = recorded_.sent[i].index;
      if (frames_[index].frame.id == id) return side_.is_block_segment(index);
    }
    return false;
  }

  /// Aborts the transfer that a frame of ours belongs to: it is not the recorded one any more.
  Result<void> give_up(std::size_t number, const std::string& why) {
    const auto& frame = frames_[recorded_.sent[number].index].frame;
    has_left_ = true;
    given_up_ = frame.id;
    const auto all = open_.all();
    const auto open = std::ranges::find(all, CanId(frame.id), &OpenTransfers::Transfer::request);
    if (open == all.end()) return {};
    const auto echo = abort(*open);
    if (!echo) return std::unexpected(echo.error());
    aborts_.push_back(*echo);
    notes_.push_back(
        fmt::format("the transfer of {} left the recorded one at frame {} and was aborted ({}): {}. What "
                    "was left of it was not sent",
                    to_string(open->object), recorded_.sent[number].index + 1,
                    canopen::describe(canopen::abort::general), why));
    return recorder_.wait_until(recorder_.now() + rest_after_abort);
  }

  /// With the code with which a run ends what it leaves open. Every tier lets aborts out to the device; to
  /// others the requests before it were let out.
  Result<std::size_t> abort(const OpenTransfers::Transfer& transfer) {
    const auto frame =
        can::data_frame(transfer.request, canopen::encode_abort(transfer.object, canopen::abort::general));
    auto echo = recorder_.send(frame);
    if (echo) open_.sent(frame);
    return echo;
  }

  /// Leaves no transfer of ours open. What was aborted, "1008h:00 on 601h, with 0800 0000h (general error)";
  /// empty: nothing was open.
  Result<std::string> abort_open() {
    const engine::StopHeld held(recorder_);
    follow(recorder_.capture().size());
    const auto all = open_.all();
    if (all.empty()) return std::string();
    for (const auto& transfer : all) {
      if (auto echo = abort(transfer); !echo) return std::unexpected(echo.error());
    }
    if (auto rested = recorder_.wait_until(recorder_.now() + rest_after_abort); !rested)
      return std::unexpected(rested.error());
    const auto more = all.size() - 1;
    return fmt::format("{} on {}{}, with {}", to_string(all.front().object), to_string(all.front().request),
                       more == 0 ? "" : fmt::format(" and {} more", more),
                       canopen::describe(canopen::abort::general));
  }

  /// The error with what it has left undone.
  Error stopped(Error error) {
    const auto& fault = recorder_.fault();
    std::string undone;
    if (!fault || fault->what == engine::stopped || fault->what == engine::flooded) {
      recorder_.clear_fault();
      const engine::StopHeld held(recorder_);
      // Echoes and answers that are under way.
      if (auto waited = recorder_.wait_until(recorder_.now() + rest_after_abort); waited) {
        const auto aborted = abort_open();
        if (aborted && !aborted->empty()) undone = "the transfer that was open was aborted: " + *aborted;
      }
    }
    if (under_way_ && was_sent(*under_way_)) ++next_;
    const auto total = recorded_.sent.size();
    auto left = std::string("all frames had been sent");
    if (next_ < total) {
      const auto first = recorded_.sent[next_].index + 1, last = recorded_.sent.back().index + 1;
      left = first == last ? fmt::format("frame {} was not sent", first)
                           : fmt::format("frames {} to {} were not sent", first, last);
    }
    for (const auto& each : {left, undone}) {
      if (!each.empty()) error.hint += (error.hint.empty() ? "" : "; ") + each;
    }
    return error;
  }

  /// The frame in the sending of which it stopped.
  [[nodiscard]] bool was_sent(std::size_t from) const {
    const auto& frames = recorder_.capture().frames();
    const auto& frame = frames_[recorded_.sent[next_].index].frame;
    return std::any_of(frames.begin() + static_cast<std::ptrdiff_t>(from), frames.end(),
                       [&](const auto& captured) {
                         return captured.direction == Direction::transmitted && captured.frame == frame;
                       });
  }

  /// From the moment that is known in both captures to a frame of the old one. Who asked before sends nothing
  /// where it is too long, see gaps_are_bounded().
  [[nodiscard]] Duration gap_to(std::size_t index) const {
    return std::min(times_.at(index) - then_, longest_gap);
  }

  /// The new capture tells the parts of the case as the old one did, but not what was found then. Marks of
  /// old frames that have none in the new capture go to the next that has one.
  void note(std::size_t index, std::size_t old) {
    for (; told_ <= old; ++told_) {
      for (const auto& mark : can::case_marks(frames_[told_].comment.view()))
        recorder_.capture().comment(index, can::to_comment(mark));
    }
  }

  [[nodiscard]] Duration limit_of(AnswerKind::Of of) const {
    switch (of) {
      case AnswerKind::Of::reset: return profile_.boot_time;
      case AnswerKind::Of::lss: return profile_.lss_timeout;
      default: return profile_.sdo_timeout;
    }
  }

  Result<void> await(const Turn& turn) {
    const auto& sent = recorded_.sent[turn.sent];
    const auto answer_index = sent.answers[*turn.answer];
    const auto& answer = frames_[answer_index];
    const auto answered_at = times_.at(answer_index);
    const auto took =
        answered_at - times_.at(*turn.answer == 0 ? sent.index : sent.answers[*turn.answer - 1]);
    auto& state = state_[turn.sent];
    if (state.over) return {};
    const auto kind = answer_of(frames_[sent.index].frame, profile_.node);
    const auto limit = std::max(limit_of(kind->of), 2 * std::min(took, longest_gap));
    const auto matches = [&kind](const can::CapturedFrame& captured) {
      return captured.direction == Direction::received && is_answer(captured.frame, *kind);
    };
    const auto found = recorder_.find(state.next, matches, state.latest + limit);
    if (!found) return std::unexpected(found.error());
    const bool is_sdo = kind->of == AnswerKind::Of::sdo;
    if (!*found) {
      state.over = has_left_ = true;
      if (is_sdo && segments_follow(turn.sent)) {
        follow(recorder_.capture().size());
        if (auto done = give_up(turn.sent, "the device does not answer, and did then"); !done) return done;
      }
      now_ = recorder_.now();
      then_ = answered_at;
      return {};
    }
    note(**found, answer_index);
    const auto& came = recorder_.capture().frames()[**found];
    state.next = **found + 1;
    state.latest = came.time;
    // Another command than then: an abort mostly, behind which nothing more comes.
    const bool is_other =
        (came.frame.data[0] ^ answer.frame.data[0]) >= command_bits || came.frame.dlc != answer.frame.dlc;
    if (is_sdo && is_other) has_left_ = true;
    state.over = is_sdo && is_abort(came.frame) && !is_abort(answer.frame);
    if (is_sdo) {
      heard_ = std::max(heard_, state.next);
      follow(state.next);
      const auto why = why_out_of_step(answer.frame, came.frame, segments_follow(turn.sent));
      if (!why.empty() && is_of_block_download(sent.index)) {
        // Sending moves the frames of the new capture.
        const auto came_at = came.time;
        if (auto done = give_up(turn.sent, why); !done) return done;
        state.over = true;
        now_ = std::max(now_, came_at);
        then_ = answered_at;
        return {};
      }
    }
    // A frame of ours may have gone out in between.
    if (answered_at >= then_) {
      now_ = std::max(now_, came.time);
      then_ = answered_at;
    }
    return {};
  }

  /// All that was done before the frame at this index of the old capture.
  Result<void> switch_power(std::size_t index) {
    for (; switched_ < recorded_.power.size() && recorded_.power[switched_] <= index; ++switched_) {
      if (!power_) return fail("the power of the device cannot be switched");
      // As far behind the frame before it as it can be told.
      if (auto done = power_(); !done) return done;
      open_.forget();
      recorder_.mark_next_frame(can::power_was_switched);
      const auto at = recorded_.power[switched_];
      const auto booted = [this](const can::CapturedFrame& captured) {
        return captured.direction == Direction::received &&
               is_answer(captured.frame, {AnswerKind::Of::reset, 0x700U + profile_.node.value()});
      };
      const auto found =
          recorder_.find(recorder_.capture().size(), booted, recorder_.now() + profile_.boot_time);
      if (!found) return std::unexpected(found.error());
      now_ = recorder_.now();
      then_ = std::max(then_, times_.at(at));
    }
    return {};
  }

  [[nodiscard]] bool is_of_block_download(std::size_t index) const {
    return side_.is_block_segment(index) || side_.meaning(index).starts_with("SDO block download request");
  }

  [[nodiscard]] bool last_was_ignored() const {
    if (recorded_.sent.empty() || !recorded_.sent.back().answers.empty()) return false;
    const auto kind = answer_of(frames_[recorded_.sent.back().index].frame, profile_.node);
    return kind && kind->of == AnswerKind::Of::sdo && !is_abort(frames_[recorded_.sent.back().index].frame);
  }

  engine::Recorder& recorder_;
  const Side& side_;
  std::span<const can::CapturedFrame> frames_;
  const Dialogue& recorded_;
  SteadyTimes times_;
  const device::Profile& profile_;
  const std::function<Result<void>()>& power_;
  std::uint32_t bit_rate_;
  std::vector<State> state_;
  std::vector<std::size_t> skipped_, aborts_;
  std::vector<std::string> notes_;
  std::size_t turn_ = 0;  ///< the one that is on
  std::size_t next_ = 0;  ///< index into Dialogue::sent of the first frame that was neither sent nor skipped
  std::optional<std::size_t> under_way_{};  ///< it may be in the new capture from here on
  OpenTransfers open_;
  std::optional<std::uint32_t> given_up_{};  ///< CAN-ID of the requests of a transfer that was aborted
  std::size_t told_;  ///< the marks of the frames of the old capture before it are told
  // Of the new capture: frames received before it are taken in, and answers before it are accounted for.
  std::size_t followed_, heard_;
  bool has_left_ = false;  ///< the server did not answer the latest request as it did then
  std::size_t switched_ = 0;
  // The same moment in both captures: gaps count from here.
  BusTime now_{}, then_{};
};

}  // namespace

Result<Played> play(engine::Recorder& recorder, const Side& then, const device::Profile& profile,
                    const std::function<Result<void>()>& power) {
  return Player(recorder, then, profile, power).run();
}

}  // namespace conform::cli
