// SPDX-License-Identifier: Apache-2.0
#include "engine/life.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "can/capture_marks.hpp"

namespace conform::engine {

using result::CaseResult;

namespace {

/// "a; b; c; ..."
std::string first_of(const std::vector<std::string>& all) {
  constexpr std::size_t most_named = 3;
  const auto named =
      std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), most_named)));
  return join(named, "; ") + (all.size() > most_named ? "; ..." : "");
}

}  // namespace

std::function<Result<void>()> Life::power_switch() {
  if (!run_.options.power_cycle) return {};
  return [this]() -> Result<void> {
    const auto& frames = run_.recorder.capture().frames();
    run_.live.follow(frames);
    if (auto done = run_.options.power_cycle(); !done) return done;
    (void)run_.recorder.now();  // the command may have taken seconds, and nobody was late
    // The start that comes now is the harness's doing.
    run_.live.lose_track();
    losses_.push_back({frames.size(), frames.size()});
    run_.recorder.mark_next_frame(can::power_was_switched);
    if (run_.options.power_away.count() == 0) return {};
    return run_.recorder.wait_until(run_.recorder.now() + run_.options.power_away);
  };
}

Means Life::means() {
  Means out{.may_command = run_.may(scenario::Risk::config)};
  const auto switch_power = power_switch();
  if (out.may_command && run_.options.power_revives && switch_power) {
    out.power_cycle = [this, switch_power]() -> Result<void> {
      auto done = switch_power();
      if (done) run_.note("the power of the device was switched, because it did not come back by a reset");
      return done;
    };
  }
  return out;
}

Result<void> Life::make_sure_it_is_alone(Duration listen) {
  if (says_all_twice_) return {};
  auto twice = answers_twice(run_.session, listen);
  if (!twice) return std::unexpected(twice.error());
  if (!*twice) return {};
  auto second = second_device(run_.session, means());
  if (!second) return std::unexpected(second.error());
  // One that violates a rule is for the scenarios.
  says_all_twice_ = !second->has_value();
  if (says_all_twice_) return {};
  return fail(**second, {}, "give one of them another node-ID, or take it off the bus");
}

const std::vector<std::size_t>& Life::restarts() {
  run_.live.follow(run_.recorder.capture().frames());
  return run_.live.restarts();
}

Result<void> Life::note_restarts() {
  const auto before = std::exchange(known_restarts_, restarts().size());
  if (known_restarts_ == before) return {};
  run_.session.device_restarted();
  return make_sure_it_is_alone(std::chrono::milliseconds(100));
}

void Life::note_losses() {
  const auto& frames = run_.recorder.capture().frames();
  const auto now = run_.recorder.transport().health();
  if (now.has_gap_since(health_)) {
    // What is still queued came before what found no room behind it. A fault of the bus stays noted.
    [[maybe_unused]] const auto heard = run_.recorder.wait_until(run_.recorder.now());
    losses_.push_back({trusted_frames_, frames.size()});
    run_.live.follow(frames);
    run_.live.lose_track();
  }
  health_ = now;
  trusted_frames_ = frames.size();
}

std::optional<monitor::Stimulus> Life::stimulus_of(std::size_t restart) const {
  return monitor::stimulus_of(run_.recorder.capture().frames(), restart, run_.profile.node,
                              run_.profile.boot_time);
}

Result<void> Life::judge_restarts(CaseResult& result, CaseRunner& runner) {
  const auto known = known_restarts_;
  if (auto alone = note_restarts(); !alone) return alone;
  if (known_restarts_ == known) return {};
  const auto restart = restarts()[known];
  const auto stimulus = stimulus_of(restart);
  auto again =
      stimulus && concerns_restart(result, restart) ? restarts_upon(*stimulus, restart) : Result<bool>(false);
  if (!again) return std::unexpected(again.error());
  runner.judge_restart(result, restart, stimulus, *again, unexplained_ > 0);
  if (!*again) ++unexplained_;
  return {};
}

/// A judgement from behind the restart is about a rule that names crashes.
bool Life::concerns_restart(const CaseResult& result, std::size_t since) const {
  return std::ranges::any_of(result.judgements, [&](const result::Judgement& each) {
    const auto* requirement = run_.catalogue.find(each.requirement);
    return each.frames_seen > since && requirement != nullptr && requirement->forbids_restart();
  });
}

/// Whether the device restarts again when it gets the same frames. A restart by itself comes at any time, and
/// what was on the bus at that moment is not to blame.
Result<bool> Life::restarts_upon(const monitor::Stimulus& stimulus, std::size_t restart) {
  constexpr std::size_t most_frames = 32;
  auto& recorder = run_.recorder;
  std::vector<can::CapturedFrame> sent;
  for (auto i = stimulus.first; i <= stimulus.last; ++i) {
    const auto& captured = recorder.capture().frames()[i];
    if (captured.direction == can::Direction::transmitted) sent.push_back(captured);
  }
  if (sent.size() > most_frames) return false;
  const auto before = known_restarts_;
  const auto took = recorder.capture().frames()[restart].time - sent.back().time;
  for (std::size_t i = 0; i < sent.size(); ++i) {
    const auto from = recorder.capture().size();
    if (auto done = recorder.send(sent[i].frame); !done) return std::unexpected(done.error());
    const auto pause =
        i + 1 < sent.size() ? sent[i + 1].time - sent[i].time : 2 * took + run_.profile.nmt_time;
    auto booted = recorder.find(from, is_boot_up_of(run_.profile.node), recorder.now() + pause);
    if (!booted) return std::unexpected(booted.error());
    if (*booted) break;
  }
  run_.session.sdo_answer_may_be_late();
  if (auto alone = note_restarts(); !alone) return std::unexpected(alone.error());
  return known_restarts_ > before;
}

/// A boot-up message behind a case may come from what happened in it.
const CaseResult* Life::case_of(std::size_t restart) const {
  const auto& cases = run_.out.cases;
  const auto case_at = [&](std::size_t at) -> const CaseResult* {
    const auto found = std::ranges::find_if(
        cases, [at](const CaseResult& each) { return at >= each.first_frame && at < each.end_frame; });
    return found == cases.end() ? nullptr : &*found;
  };
  if (const auto* found = case_at(restart)) return found;
  const auto stimulus = stimulus_of(restart);
  if (!stimulus) return nullptr;
  // Since then the engine may have asked whether the device is still there.
  const auto* found = case_at(stimulus->last);
  return found != nullptr ? found : case_at(stimulus->first);
}

void Life::tell_restarts() {
  std::vector<std::string> where;
  for (const auto index : restarts()) {
    const auto* in = case_of(index);
    where.push_back("frame " + std::to_string(index + 1) +
                    (in == nullptr ? ", between cases" : ", in " + in->name()));
  }
  if (where.empty()) return;
  run_.note("the device restarted " + (where.size() == 1 ? "once" : std::to_string(where.size()) + " times") +
            " although nobody told it to: " + first_of(where));
}

void Life::tell_tries() {
  if (tried_again_.empty()) return;
  const auto count = tried_again_.size();
  run_.note("the machine was late: " + (count == 1 ? "one case was" : std::to_string(count) + " cases were") +
            " tried again: " + first_of(tried_again_));
}

void Life::tell_losses() {
  if (health_.frames_dropped == 0) return;
  run_.note("the host lost " + std::to_string(health_.frames_dropped) +
            " frames of the run: the capture lacks them, and what they might have decided is inconclusive");
}

std::size_t Life::last_heard() const {
  const auto& frames = run_.recorder.capture().frames();
  for (auto i = frames.size(); i > 0; --i) {
    if (is_from_node(run_.session, frames[i - 1])) return i;
  }
  return 0;
}

}  // namespace conform::engine
