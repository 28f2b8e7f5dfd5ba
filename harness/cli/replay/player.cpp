// SPDX-License-Identifier: Apache-2.0
#include "cli/replay/player.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "can/capture_marks.hpp"
#include "can/frame_time.hpp"
#include "cli/replay/stamps.hpp"
#include "engine/tier_guard.hpp"

namespace conform::cli {
namespace {

using can::Direction;

/// The command specifier of a server: bits 7 to 5.
constexpr unsigned command_bits = 0x20;

bool is_abort(const can::Frame& frame) { return frame.size() == 8 && frame.data[0] == 0x80; }

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
        told_(side.first) {}

  Result<Played> run() {
    Played out;
    out.first = recorder_.capture().size();
    now_ = recorder_.now();
    then_ = times_.at(side_.first);
    for (const auto& turn : recorded_.turns) {
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
    out.skipped = std::move(skipped_);
    return out;
  }

 private:
  struct State {
    std::size_t next = 0;  ///< capture index from which on its next answer is looked for
    bool over = false;     ///< nothing more is waited for
    BusTime latest{};      ///< it, or its latest answer
  };

  Result<void> send(std::size_t number) {
    const auto index = recorded_.sent[number].index;
    const auto& captured = frames_[index];
    const bool is_segment = side_.is_block_segment(index);
    if (is_segment && has_left_) {
      skipped_.push_back(number);
      state_[number].over = true;
      return {};
    }
    const auto kind = answer_of(captured.frame, profile_.node);
    if (!is_segment && kind && kind->of == AnswerKind::Of::sdo) has_left_ = false;
    auto due = now_ + gap_to(index);
    // Stamps are of the end of a frame.
    if (bit_rate_ > 0) due -= can::bit_time(can::frame_bits(captured.frame), bit_rate_);
    if (due > recorder_.now()) {
      if (auto waited = recorder_.wait_until(due); !waited) return waited;
    }
    const auto echo = recorder_.send(captured.frame);
    if (!echo) return std::unexpected(echo.error());
    note(*echo, index);
    now_ = recorder_.capture().frames()[*echo].time;
    then_ = times_.at(index);
    state_[number] = {recorder_.first_effect(*echo), false, now_};
    return {};
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
      for (const auto& mark : can::case_marks(frames_[told_].comment))
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
    if (!*found) {
      state.over = has_left_ = true;
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
    if (kind->of == AnswerKind::Of::sdo && is_other) has_left_ = true;
    state.over = kind->of == AnswerKind::Of::sdo && is_abort(came.frame) && !is_abort(answer.frame);
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
  std::vector<std::size_t> skipped_;
  std::size_t told_;       ///< the marks of the frames of the old capture before it are told
  bool has_left_ = false;  ///< the server did not answer the latest request as it did then
  std::size_t switched_ = 0;
  // The same moment in both captures: gaps count from here.
  BusTime now_{}, then_{};
};

}  // namespace

Result<void> may_replay(const Side& then, const device::Profile& profile, steps::Tier allowed) {
  const auto dictionary = device::dictionary_of(profile);
  const engine::TierGuard guard(profile, dictionary);
  const auto number = [](std::size_t index) { return "frame " + std::to_string(index + 1); };
  const auto refuse = [&](std::size_t index, const steps::Need& need) -> std::unexpected<Error> {
    return fail("the replay would " + std::string(need.what), number(index),
                "--allow " + std::string(steps::word_of(need.tier)) + " lets it; nothing was sent");
  };
  for (const auto& sent : then.dialogue.sent) {
    const auto& frame = then.at(sent.index).frame;
    constexpr std::uint32_t longest_base_id = 0x7FF;
    if (!frame.extended && frame.id > longest_base_id)
      return fail("is no frame that can be sent: a CAN-ID of 11 bits that has more", number(sent.index),
                  "nothing was sent");
    // Each frame for itself, whatever the capture says that it was: a segment of a block download looks like
    // any other request to a server that has left the transfer, and this one may leave it where that one did
    // not.
    const auto object = steps::download_begun(frame, profile.node);
    const auto need = object ? steps::need_of_download(*object) : steps::need_of(frame, profile.node);
    if (!need.covered_by(allowed)) return refuse(sent.index, need);
    if (!object || guard.may_write(*object)) continue;
    if (profile.is_untouchable(*object)) {
      return fail(
          "the replay would write to " + to_string(*object) + ", which is untouchable in the device profile",
          number(sent.index), "nothing was sent");
    }
    return fail(
        "the replay would write to " + to_string(*object) + ", which the device profile does not call safe",
        number(sent.index), "--device FILE with the profile of the run that was recorded; nothing was sent");
  }
  const steps::Need power{steps::Tier::config, "switch the power of the device"};
  const auto& switches = then.dialogue.power;
  if (!switches.empty() && !power.covered_by(allowed)) return refuse(switches.front(), power);
  return {};
}

Result<Played> play(engine::Recorder& recorder, const Side& then, const device::Profile& profile,
                    const std::function<Result<void>()>& power) {
  return Player(recorder, then, profile, power).run();
}

}  // namespace conform::cli
