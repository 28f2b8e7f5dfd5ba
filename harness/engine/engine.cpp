// SPDX-License-Identifier: Apache-2.0
#include "engine/engine.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "base/text.hpp"
#include "canopen/nmt.hpp"
#include "engine/case_runner.hpp"
#include "engine/discovery.hpp"
#include "engine/liveness.hpp"
#include "engine/monitor_cases.hpp"
#include "engine/restore.hpp"
#include "engine/run_session.hpp"
#include "engine/trust.hpp"
#include "result/annotate.hpp"

namespace conform::engine {
namespace {

using result::CaseResult;
using result::Verdict;

constexpr Multiplexer emcy_inhibit_time{Index(0x1015), SubIndex(0)};

/// While values are put back the bus must be usable, whatever the user wants meanwhile. A second signal still
/// ends the program.
class StopHeld {
 public:
  explicit StopHeld(Recorder& recorder) : recorder_(recorder) { recorder_.ignore_stop(true); }
  ~StopHeld() { recorder_.ignore_stop(false); }
  StopHeld(const StopHeld&) = delete;
  StopHeld& operator=(const StopHeld&) = delete;

 private:
  Recorder& recorder_;
};

/// Everything one run needs; one function per phase.
class Run {
 public:
  Run(can::Transport& transport, const device::Profile& profile, const scenario::Suite& suite,
      const scenario::Catalogue& catalogue, const RunOptions& options)
      : profile_(profile),
        suite_(suite),
        catalogue_(catalogue),
        options_(options),
        recorder_(transport, options.stop),
        session_(recorder_, profile_, device::dictionary_of(profile_)),
        attribution_(facts_of(profile)),
        runner_(session_, catalogue_, attribution_, options.strict,
                options.plan.allowed >= scenario::Risk::config),
        restarts_(facts_of(profile)) {
    session_.try_all_objects(options.plan.all_objects);
    if (options.observer != nullptr) recorder_.set_observer(*options.observer);
    session_.allow(options.plan.allowed);
  }

  result::RunResult execute() {
    out_.device = profile_.name.empty() ? "node " + std::to_string(profile_.node.value()) : profile_.name;
    const auto begin = recorder_.now();
    auto ready = prepare();
    make_plan();
    recorder_.observer().planned(out_);
    if (!ready) {
      abort_run(ready.error());
    } else if (!alive_) {
      abort_run({"nothing was heard of node " + std::to_string(profile_.node.value()),
                 {},
                 "node-ID, bit rate, power?"});
    } else {
      run_cases();
    }
    tell_restarts();
    judge_monitors();
    out_.elapsed = recorder_.now() - begin;
    if (options_.stop != nullptr) out_.signal = options_.stop->load();
    return std::move(out_);
  }

  can::Capture take_capture() { return std::move(recorder_.capture()); }

 private:
  [[nodiscard]] bool may(scenario::Risk risk) const { return risk <= options_.plan.allowed; }

  /// What may be done to a device that does not answer.
  [[nodiscard]] Means means() {
    Means out{.may_command = may(scenario::Risk::config)};
    if (out.may_command && options_.power_cycle) {
      out.power_cycle = [this]() -> Result<void> {
        (void)restarts_.follow(recorder_.capture().frames());
        auto done = options_.power_cycle();
        if (!done) return done;
        out_.notes.push_back("the power of the device was switched, because it did not come back by a reset");
        // The start that comes now is the harness's doing.
        restarts_.lose_track();
        losses_.push_back({recorder_.capture().size(), recorder_.capture().size()});
        return {};
      };
    }
    return out;
  }

  /// Two devices with one node-ID would be blamed for each other.
  Result<void> make_sure_it_is_alone(Duration listen) {
    if (says_all_twice_) return {};
    auto twice = answers_twice(session_, listen);
    if (!twice) return std::unexpected(twice.error());
    if (!*twice) return {};
    auto second = second_device(session_, means());
    if (!second) return std::unexpected(second.error());
    // One that violates a rule is for the scenarios.
    says_all_twice_ = !second->has_value();
    if (says_all_twice_) return {};
    return fail(**second, {}, "give one of them another node-ID, or take it off the bus");
  }

  /// A start that nobody asked for leaves the device in its power-on state; or a second device has joined.
  Result<void> note_restarts() {
    if (!restarts_.follow(recorder_.capture().frames())) return {};
    session_.device_restarted();
    return make_sure_it_is_alone(std::chrono::milliseconds(100));
  }

  Result<void> prepare() {
    auto liveness = probe(session_, means());
    if (!liveness) return std::unexpected(liveness.error());
    alive_ = liveness->alive;
    mute_ = alive_ && !liveness->answers;
    if (!alive_) return {};
    if (mute_) {
      out_.notes.push_back("heard " + liveness->heard);
      return {};
    }
    if (auto alone = make_sure_it_is_alone(std::chrono::milliseconds(100)); !alone) return alone;
    if (may(scenario::Risk::config)) {
      if (auto done = enter_pre_operational(); !done) return done;
    }
    auto silent = discover(session_, means());
    if (!silent) return std::unexpected(silent.error());
    if (!silent->empty()) {
      std::vector<std::string> names;
      for (const auto object : *silent) names.push_back(to_string(object));
      out_.notes.push_back("requests for " + join(names, ", ") + " are not answered");
    }
    if (auto alone = note_restarts(); !alone) return alone;
    const bool told_how =
        std::ranges::any_of(profile_.errors, [](const auto& error) { return error.raise.has_value(); });
    if (may(scenario::Risk::config) && !may(scenario::Risk::motion) && !told_how) {
      out_.notes.push_back(
          "no error was raised: the device profile tells no way (errors:), and the heartbeat of another node that stays "
          "away needs --allow motion");
    }
    auto properties = device_properties(session_);
    if (!properties) return std::unexpected(properties.error());
    out_.properties = std::move(*properties);
    for (const auto& property : out_.properties) {
      if (property.name == "dut.name" && profile_.name.empty()) out_.device += " (" + property.value + ")";
    }
    auto values = snapshot(session_);
    if (!values) return std::unexpected(values.error());
    snapshot_ = std::move(*values);
    auto errors = has_errors();
    if (!errors) return std::unexpected(errors.error());
    free_of_errors_ = !*errors;
    auto stores = stores_by_itself();
    if (!stores) return std::unexpected(stores.error());
    stores_by_itself_ = *stores;
    auto inhibit = session_.is_present(emcy_inhibit_time, false);
    if (!inhibit) return std::unexpected(inhibit.error());
    if (!*inhibit) return {};
    auto held = session_.peek(emcy_inhibit_time);
    if (!held) return std::unexpected(held.error());
    if (held->kind == steps::SdoAnswer::Kind::confirmed && held->data.size() == 2)
      emcy_inhibit_ = std::chrono::microseconds(100) * static_cast<std::int64_t>(load_le(held->data));
    return {};
  }

  /// Bit 1 of 1010h:01 to 7Fh (CiA 301, 7.5.2.13), or the profile says so.
  Result<bool> stores_by_itself() {
    if (profile_.claimed("autonomous storing")) return true;
    for (const auto& entry : session_.known().object(Index(0x1010))) {
      if (entry.mux.sub == SubIndex(0) || entry.mux.sub > SubIndex(0x7F)) continue;
      const auto held = session_.peek(entry.mux);
      if (!held) return std::unexpected(held.error());
      if (held->kind == steps::SdoAnswer::Kind::confirmed && (load_le(held->data) & 2U) != 0) return true;
    }
    return false;
  }

  void make_plan() {
    plan_ = plan(suite_, catalogue_, session_.known(), options_.plan);
    for (const auto& planned : plan_) out_.cases.push_back(planned_result(planned, catalogue_));
    monitors_ = chosen_monitors(options_.plan.selection, catalogue_);
    plan_monitors(monitors_, catalogue_, out_);
    describe_requirements(catalogue_, out_);
  }

  void abort_run(const Error& error) {
    if (error.what == stopped) {
      out_.aborted = "stopped by the user";
    } else {
      out_.aborted = error.text();
    }
  }

  void run_cases() {
    for (std::size_t i = 0; i < plan_.size(); ++i) {
      auto& result = out_.cases[i];
      if (!plan_[i].held_back.empty() || !plan_[i].not_applicable.empty()) {
        result.verdict = Verdict::not_applicable;
        result.reason = plan_[i].held_back.empty() ? plan_[i].not_applicable : plan_[i].held_back;
        result.wants = plan_[i].wants;
        result.finished = true;
        result.begin = result.end = recorder_.now();
        recorder_.observer().case_ended(out_, i);
        continue;
      }
      if (mute_ && !plan_[i].scenario->basic) continue;
      if (const auto* broken = ground_lost(*plan_[i].scenario)) {
        // It costs no bus time: whatever came would say nothing.
        result.verdict = Verdict::inconclusive;
        result.rests_on = broken->requirement;
        result.reason = "rests on " + broken->requirement + ", which failed in " + broken->in;
        result.finished = true;
        result.begin = result.end = recorder_.now();
        recorder_.observer().case_ended(out_, i);
        continue;
      }
      recorder_.observer().case_begun(out_, i);
      auto done = run_case(plan_[i], result);
      note_channels(*plan_[i].scenario, result);
      recorder_.observer().case_ended(out_, i);
      if (!done) {
        abort_run(done.error());
        break;
      }
      if (fell_silent_) {
        abort_run(*fell_silent_);
        break;
      }
    }
    if (mute_) {
      abort_run({"the device is there, but its default SDO server does not answer",
                 {},
                 "only what needs no answer was judged"});
    }
    finish();
  }

  /// A channel that failed, with the requirement that says so.
  struct Broken {
    std::string requirement, in;
  };

  [[nodiscard]] const Broken* ground_lost(const scenario::Scenario& scenario) const {
    for (const auto channel : scenario.rests_on) {
      const auto found = broken_channels_.find(channel);
      if (found != broken_channels_.end()) return &found->second;
    }
    return nullptr;
  }

  void note_channels(const scenario::Scenario& scenario, const CaseResult& result) {
    for (const auto channel : scenario.establishes) {
      if (broken_channels_.contains(channel)) continue;
      const auto failed = std::ranges::find(result.judgements, Verdict::fail, &result::Judgement::verdict);
      if (failed != result.judgements.end()) {
        broken_channels_[channel] = {failed->requirement, result.name()};
      } else if (result.verdict == Verdict::inconclusive && !result.rests_on.empty()) {
        broken_channels_[channel] = {result.rests_on, result.name()};
      }
    }
  }

  Result<void> run_case(const PlannedCase& planned, CaseResult& out) {
    if (auto ready = baseline(*planned.scenario); !ready) {
      out.reason = "not run: " + ready.error().text();
      // A reset may have brought back what cases before this one wrote.
      restore_after_fault(nullptr);
      return ready;
    }
    note_losses();
    if (auto alone = note_restarts(); !alone) {
      out.reason = "not run: " + alone.error().text();
      restore_after_fault(nullptr);
      return alone;
    }
    out.begin = recorder_.now();
    out.first_frame = recorder_.capture().size();
    const auto health = recorder_.transport().health();
    recorder_.set_losses(health.frames_dropped);
    (void)recorder_.take_lateness();
    auto ran = runner_.run(planned, out);
    const bool entered = runner_.entered_steps();
    out.end_frame = recorder_.capture().size();
    note_losses();
    out.end = recorder_.now();
    const auto lateness = recorder_.take_lateness();
    if (ran) ran = after_case(out);
    if (!ran) {
      // The environment failed in the middle: nothing of this case counts as passed or failed.
      withdraw(out, vanished_ ? last_heard() : 0);
      out.reason =
          ran.error().what == stopped ? "stopped by the user before the case ended" : ran.error().text();
      restore_after_fault(entered ? &planned : nullptr);
      return ran;
    }
    out.finished = true;
    const bool other_client =
        session_.channel().has_other_client(out.first_frame, recorder_.capture().size());
    if (const auto trouble = trouble_of(health, recorder_.transport().health(), lateness, other_client))
      distrust(out, *trouble);
    accept_known_deviations(profile_, catalogue_, out);
    return {};
  }

  /// Where the host lost frames, or its clock was set, the monitors must not draw conclusions.
  void note_losses() {
    const auto now = recorder_.transport().health();
    const auto frames = recorder_.capture().size();
    if (now.frames_dropped > health_.frames_dropped || now.bus_offs > health_.bus_offs ||
        now.clock_steps > health_.clock_steps) {
      losses_.push_back({trusted_frames_, frames});
      (void)restarts_.follow(recorder_.capture().frames());
      restarts_.lose_track();
      attribution_.follow(recorder_.capture().frames());
      attribution_.lose_track();
    }
    health_ = now;
    trusted_frames_ = frames;
  }

  /// The monitors see the whole trace, also of a run that stopped early. A device that was never heard leaves
  /// them nothing to do.
  void judge_monitors() {
    if (monitors_.empty() || !alive_) return;
    note_losses();
    judge_trace(recorder_.capture().frames(), monitors_, profile_, catalogue_, options_.strict, losses_, out_,
                true);
    // The preparation is no test of anything, unless only monitors were asked for.
    const auto scenarios = std::span(out_.cases).first(plan_.size());
    const auto was_run = [](const CaseResult& each) { return each.first_frame < each.end_frame; };
    if (out_.aborted && !plan_.empty() && std::ranges::none_of(scenarios, was_run))
      withdraw_passes(std::span(out_.cases).last(monitors_.size()), "the run stopped before any scenario");
    for (auto i = out_.cases.size() - monitors_.size(); i < out_.cases.size(); ++i)
      recorder_.observer().case_ended(out_, i);
  }

  /// In the summary; a boot-up message behind a case may come from what happened in it.
  void tell_restarts() {
    const auto& frames = recorder_.capture().frames();
    (void)restarts_.follow(frames);
    constexpr std::size_t most_named = 3;
    std::vector<std::string> where;
    for (const auto index : restarts_.found()) {
      const auto stimulus = monitor::stimulus_of(frames, index, profile_.node, profile_.boot_time);
      const auto case_at = [this](std::size_t at) {
        return std::ranges::find_if(out_.cases, [at](const CaseResult& each) {
          return at >= each.first_frame && at < each.end_frame;
        });
      };
      auto found = case_at(index);
      if (found == out_.cases.end() && stimulus) found = case_at(stimulus->last);
      // Since then the engine may have asked whether the device is still there.
      if (found == out_.cases.end() && stimulus) found = case_at(stimulus->first);
      where.push_back("frame " + std::to_string(index + 1) +
                      (found == out_.cases.end() ? ", between cases" : ", in " + found->name()));
    }
    if (where.empty()) return;
    const auto count = where.size();
    if (count > most_named) where.resize(most_named);
    out_.notes.push_back("the device restarted " + (count == 1 ? "once" : std::to_string(count) + " times") +
                         " although nobody told it to: " + join(where, "; ") +
                         (count > most_named ? "; ..." : ""));
  }

  /// Pre-operational, SDO channel idle, and freshly reset where the scenario asks for it.
  Result<void> baseline(const scenario::Scenario& scenario) {
    if (auto idle = session_.channel().make_idle(); !idle) return idle;
    if (!may(scenario::Risk::config)) return {};
    if (scenario.fresh != scenario::Fresh::none) {
      if (auto done =
              reset(scenario.fresh == scenario::Fresh::node ? canopen::NmtCommand::reset_node
                                                            : canopen::NmtCommand::reset_communication);
          !done) {
        return std::unexpected(done.error());
      }
    }
    if (auto ready = enter_pre_operational(); !ready) return ready;
    if (stores_by_itself_ && session_.resets() != resets_looked_at_) {
      resets_looked_at_ = session_.resets();
      const StopHeld held(recorder_);
      note_left(put_back_what_returned());
    }
    return {};
  }

  Result<void> enter_pre_operational() {
    if (!session_.take_state_changed()) return {};
    // A device that is still booting would not hear the command, nor answer what comes next.
    if (const auto reset = session_.take_reset()) {
      auto booted = recorder_.find(*reset + 1, is_boot_up_of(profile_.node),
                                   recorder_.capture().frames()[*reset].time + profile_.boot_time);
      if (!booted) return std::unexpected(booted.error());
    }
    auto sent = session_.command(canopen::NmtCommand::pre_operational);
    if (!sent) return sent;
    (void)session_.take_state_changed();
    return session_.wait_until(session_.now() + profile_.nmt_time);
  }

  /// False: no boot-up message came.
  Result<bool> reset(canopen::NmtCommand command) {
    const auto from = recorder_.capture().size();
    auto sent = session_.command(command);
    if (!sent) return std::unexpected(sent.error());
    auto booted = recorder_.find(from, is_boot_up_of(profile_.node), recorder_.now() + profile_.boot_time);
    if (!booted) return std::unexpected(booted.error());
    return booted->has_value();
  }

  /// Puts everything back and makes sure that the device is still there.
  Result<void> after_case(CaseResult& out) {
    recorder_.stop_producing("");
    if (session_.silence_seen() || out.verdict == Verdict::fail || out.verdict == Verdict::inconclusive) {
      auto revival = mute_ ? Result<Revival>(Revival{.life = Life::there}) : look_for_life(session_, means());
      if (!revival) return std::unexpected(revival.error());
      if (revival->was_reset)
        out_.notes.push_back("the device had to be reset because it did not answer any more");
      if (revival->life == Life::there) {
        // It is there and violates the rule under test by its silence; what would come next has nothing to
        // ask.
        if (!mute_) {
          fell_silent_ = Error{"since " + out.name() + " the SDO server does not answer", {}, revival->tried};
        }
        note_not_put_back("the SDO server does not answer");
        return {};
      }
      if (revival->life == Life::gone) {
        vanished_ = true;
        return fail("the device vanished during " + out.name(), {}, revival->tried);
      }
      if (auto alone = make_sure_it_is_alone(std::chrono::milliseconds(20)); !alone) return alone;
    }
    if (auto judged = judge_restarts(out); !judged) return judged;
    auto changes = take_changes();
    if (changes.empty()) return let_errors_end(out);
    // A stop request waits until everything is back: half a restore is the worst of all.
    const StopHeld held(recorder_);
    if (auto ready = enter_pre_operational(); !ready) return ready;
    auto report = restore(session_, changes);
    if (!report) return std::unexpected(report.error());
    if (!report->left.empty() && may(scenario::Risk::config)) {
      // What cannot be written back is lost with a reset, unless it was stored.
      auto booted = reset(canopen::NmtCommand::reset_node);
      if (!booted) return std::unexpected(booted.error());
      if (auto ready = enter_pre_operational(); !ready) return ready;
      report = restore(session_, std::move(changes));
      if (!report) return std::unexpected(report.error());
    }
    for (const auto& left : report->left)
      out_.notes.push_back(out.name() + ": could not be put back: " + left);
    if (!report->left.empty()) session_.note_left_changed();
    return let_errors_end(out);
  }

  Result<void> let_errors_end(const CaseResult& out) {
    if (auto done = let_emcy_end(out.first_frame); !done) return done;
    return clear_what_stays(out);
  }

  /// An error that stays would make the next trigger silent: it is there already. Where the device knew of no
  /// error at first, a reset ends those of the case that did not end by themselves.
  Result<void> clear_what_stays(const CaseResult& out) {
    if (!free_of_errors_ || !may(scenario::Risk::config) || !has_raised_errors(out.first_frame)) return {};
    auto stays = has_errors();
    if (!stays) return std::unexpected(stays.error());
    if (!*stays) return {};
    // Perhaps it has not noticed yet.
    if (auto waited = session_.wait_until(session_.now() + std::chrono::milliseconds(200)); !waited)
      return waited;
    stays = has_errors();
    if (!stays) return std::unexpected(stays.error());
    if (!*stays) return {};
    if (auto booted = reset(canopen::NmtCommand::reset_node); !booted) return std::unexpected(booted.error());
    if (auto ready = enter_pre_operational(); !ready) return ready;
    stays = has_errors();
    if (!stays) return std::unexpected(stays.error());
    if (*stays) {
      free_of_errors_ = false;
      out_.notes.push_back("since " + out.name() +
                           " the device tells of an error (1001h) that nothing ends, not even a reset");
    }
    return {};
  }

  /// By a trigger of the profile, or in any other way that it sends an EMCY about.
  [[nodiscard]] bool has_raised_errors(std::size_t from) const {
    if (session_.find("trigger_delay") != nullptr) return true;
    const auto& frames = recorder_.capture().frames();
    return std::any_of(frames.begin() + static_cast<std::ptrdiff_t>(from), frames.end(),
                       [this](const can::CapturedFrame& captured) {
                         const auto& frame = captured.frame;
                         return captured.direction == can::Direction::received &&
                                frame.is_data(session_.emcy_can_id()) && frame.size() == 8 &&
                                (frame.data[0] != 0 || frame.data[1] != 0);
                       });
  }

  Result<bool> has_errors() {
    const auto held = session_.peek({Index(0x1001), SubIndex(0)});
    if (!held) return std::unexpected(held.error());
    return held->kind == steps::SdoAnswer::Kind::confirmed && load_le(held->data) != 0;
  }

  /// What the inhibit time (1015h) still holds back would be taken for an EMCY of the next case.
  Result<void> let_emcy_end(std::size_t from) {
    const auto seen_since = [this](std::size_t first) {
      const auto& frames = recorder_.capture().frames();
      return std::any_of(frames.begin() + static_cast<std::ptrdiff_t>(first), frames.end(),
                         [this](const can::CapturedFrame& captured) {
                           return captured.direction == can::Direction::received &&
                                  captured.frame.is_data(session_.emcy_can_id());
                         });
    };
    constexpr int most_held_back = 16;
    for (int held = 0; emcy_inhibit_ > Duration::zero() && held < most_held_back && seen_since(from);
         ++held) {
      from = recorder_.capture().size();
      const auto margin = std::chrono::milliseconds(10);
      if (auto waited = session_.wait_until(session_.now() + emcy_inhibit_ + margin); !waited) return waited;
    }
    return {};
  }

  /// A start that nobody asked for, while the case ran: what was judged afterwards was judged of another
  /// device.
  Result<void> judge_restarts(CaseResult& out) {
    const auto known = restarts_.found().size();
    if (auto alone = note_restarts(); !alone) return alone;
    if (restarts_.found().size() == known) return {};
    const auto restart = restarts_.found()[known];
    const auto stimulus =
        monitor::stimulus_of(recorder_.capture().frames(), restart, profile_.node, profile_.boot_time);
    auto again =
        stimulus && concerns_restart(out, restart) ? restarts_upon(*stimulus, restart) : Result<bool>(false);
    if (!again) return std::unexpected(again.error());
    runner_.judge_restart(out, restart, stimulus, *again, unexplained_ > 0);
    if (!*again) ++unexplained_;
    return {};
  }

  /// A judgement from behind the restart is about a rule that names crashes.
  bool concerns_restart(const CaseResult& out, std::size_t since) const {
    return std::ranges::any_of(out.judgements, [&](const result::Judgement& each) {
      const auto* requirement = catalogue_.find(each.requirement);
      return each.frames_seen > since && requirement != nullptr && requirement->forbids_restart();
    });
  }

  /// Whether the device restarts again when it gets the same frames. A restart by itself comes at any time,
  /// and what was on the bus at that moment is not to blame.
  Result<bool> restarts_upon(const monitor::Stimulus& stimulus, std::size_t restart) {
    constexpr std::size_t most_frames = 32;
    std::vector<can::CapturedFrame> sent;
    for (auto i = stimulus.first; i <= stimulus.last; ++i) {
      const auto& captured = recorder_.capture().frames()[i];
      if (captured.direction == can::Direction::transmitted) sent.push_back(captured);
    }
    if (sent.size() > most_frames) return false;
    const auto before = restarts_.found().size();
    const auto took = recorder_.capture().frames()[restart].time - sent.back().time;
    for (std::size_t i = 0; i < sent.size(); ++i) {
      const auto from = recorder_.capture().size();
      if (auto done = recorder_.send(sent[i].frame); !done) return std::unexpected(done.error());
      const auto pause = i + 1 < sent.size() ? sent[i + 1].time - sent[i].time : 2 * took + profile_.nmt_time;
      auto booted = recorder_.find(from, is_boot_up_of(profile_.node), recorder_.now() + pause);
      if (!booted) return std::unexpected(booted.error());
      if (*booted) break;
    }
    session_.sdo_answer_may_be_late();
    if (auto alone = note_restarts(); !alone) return std::unexpected(alone.error());
    return restarts_.found().size() > before;
  }

  /// Index behind the last frame of the device, 0 when none came.
  [[nodiscard]] std::size_t last_heard() const {
    const auto& frames = recorder_.capture().frames();
    for (auto i = frames.size(); i > 0; --i) {
      if (is_from_node(session_, frames[i - 1])) return i;
    }
    return 0;
  }

  /// The case did not come to its end: nothing of it has passed, and a device that is gone has not violated a
  /// rule by its silence. Only what was found while the device was still heard afterwards remains.
  static void withdraw(CaseResult& out, std::size_t last_heard) {
    out.verdict = Verdict::error;
    for (auto& judgement : out.judgements) {
      judgement.verdict = Verdict::error;
      for (auto& finding : judgement.findings) {
        if (finding.frames_seen >= last_heard) finding.verdict = Verdict::error;
        judgement.verdict = worst(judgement.verdict, finding.verdict);
      }
      out.verdict = worst(out.verdict, judgement.verdict);
    }
  }

  /// The bus broke or the user stopped: values are put back if that is still possible.
  void restore_after_fault(const PlannedCase* planned) {
    recorder_.stop_producing("");
    const bool usable =
        recorder_.fault() && (recorder_.fault()->what == stopped || recorder_.fault()->what == flooded);
    if (!usable) {
      note_not_put_back("the bus or the device is gone");
      return;
    }
    recorder_.clear_fault();
    const StopHeld held(recorder_);
    // An open transfer is ended, also where nothing was changed.
    session_.sdo_channel_dirty();
    if (auto idle = session_.channel().make_idle(); !idle) {
      out_.notes.push_back("the SDO channel may not be idle: " + idle.error().text());
    }
    // What is stored in the device only the scenario can put back.
    if (planned != nullptr) {
      if (auto done = runner_.clean_up(*planned->scenario); !done) {
        out_.notes.push_back("the cleanup of the stopped case did not end: " + done.error().text());
      }
    }
    // First the state: in Stopped no SDO would be answered.
    leave_in_pre_operational();
    auto report = restore(session_, take_changes());
    if (!report) {
      out_.notes.push_back("values may not have been put back: " + report.error().text());
      return;
    }
    note_left(report->left);
    note_left(put_back_what_returned());
  }

  /// The journal of a case; that its entries were written is remembered: a reset may bring back what was
  /// written.
  std::vector<Change> take_changes() {
    auto changes = session_.take_journal();
    for (const auto& change : changes) written_.insert(change.object);
    return changes;
  }

  /// A device that stores by itself (1010h, bit 1, or without saying so) may have stored what a test wrote,
  /// and a later reset brought it back after it had been put right. What the run never wrote is left alone:
  /// the device changed it. Gives what could not be put back.
  std::vector<std::string> put_back_what_returned() {
    std::vector<Change> returned;
    for (const auto& [object, before] : snapshot_) {
      if (!written_.contains(object)) continue;
      const auto found = session_.peek(object);
      if (!found) return {};
      if (found->kind == steps::SdoAnswer::Kind::confirmed && found->data != before)
        returned.push_back({object, before});
    }
    if (returned.empty()) return {};
    auto report = restore(session_, std::move(returned));
    // An environment that failed shows in the next step of the run.
    return report ? std::move(report->left) : std::vector<std::string>{};
  }

  /// Says once of each value that it could not be put back.
  void note_left(const std::vector<std::string>& left) {
    for (const auto& each : left) {
      session_.note_left_changed();
      if (left_.insert(each).second) out_.notes.push_back("could not be put back: " + each);
    }
  }

  void note_not_put_back(const std::string& why) {
    for (const auto& change : session_.take_journal()) {
      out_.notes.push_back("not put back, " + why + ": " + to_string(change.object) + " was " +
                           hex_bytes(change.before));
    }
  }

  /// The state a device is left in; that it could not be commanded is said, not judged.
  void leave_in_pre_operational() {
    if (!may(scenario::Risk::config)) return;
    if (auto done = enter_pre_operational(); !done) {
      out_.notes.push_back("the device may not be in Pre-operational: " + done.error().text());
    }
  }

  /// The device is left as it was found; what is not is said.
  void finish() {
    if (out_.aborted) return;
    {
      const StopHeld held(recorder_);
      leave_in_pre_operational();
      // What is left shows in the comparison that follows.
      if (may(scenario::Risk::config)) (void)put_back_what_returned();
    }
    // The same entries, whatever has been learnt about access in between.
    for (const auto& [object, before] : snapshot_) {
      const auto found = session_.peek(object);
      if (!found) return;
      if (found->kind != steps::SdoAnswer::Kind::confirmed) {
        out_.notes.push_back(to_string(object) + " could be read before the run and cannot any more");
      } else if (found->data != before) {
        out_.notes.push_back(to_string(object) + " was " + hex_bytes(before) + " before the run and is " +
                             hex_bytes(found->data));
      }
    }
  }

  const device::Profile& profile_;
  const scenario::Suite& suite_;
  const scenario::Catalogue& catalogue_;
  const RunOptions& options_;
  Recorder recorder_;
  RunSession session_;
  Attribution attribution_;
  CaseRunner runner_;
  RestartWatch restarts_;
  std::size_t unexplained_ = 0;  ///< restarts without a known cause
  bool says_all_twice_ = false;  ///< one device, and the scenarios judge it
  bool alive_ = false;
  bool vanished_ = false;
  bool mute_ = false;                 ///< alive, but without a single SDO answer
  std::optional<Error> fell_silent_;  ///< during the run
  std::vector<PlannedCase> plan_;
  std::map<std::string_view, Broken> broken_channels_;
  Monitors monitors_;
  std::vector<monitor::Loss> losses_;
  can::BusHealth health_;           ///< at the last look
  std::size_t trusted_frames_ = 0;  ///< capture's length at that time
  std::map<Multiplexer, Bytes> snapshot_;
  std::set<Multiplexer> written_;  ///< by cases, at any time of the run
  std::set<std::string> left_;     ///< what the notes say of values that a reset brought back
  bool stores_by_itself_ = false;
  std::size_t resets_looked_at_ = 0;  ///< of session_.resets(): what came back after them has been put right
  bool free_of_errors_ = false;       ///< 1001h was 0 before the first case, and a reset makes it 0 again
  Duration emcy_inhibit_{};           ///< 1015h, as found
  result::RunResult out_;
};

}  // namespace

result::RunResult run(can::Transport& transport, const device::Profile& profile, const scenario::Suite& suite,
                      const scenario::Catalogue& catalogue, const RunOptions& options,
                      can::Capture& capture) {
  Run run(transport, profile, suite, catalogue, options);
  auto out = run.execute();
  capture = run.take_capture();
  result::annotate(capture, out);
  return out;
}

}  // namespace conform::engine
