// SPDX-License-Identifier: Apache-2.0
#include "engine/engine.hpp"

#include <algorithm>
#include <chrono>
#include <span>

#include "base/text.hpp"
#include "can/capture_marks.hpp"
#include "engine/baseline.hpp"
#include "engine/budget.hpp"
#include "engine/case_runner.hpp"
#include "engine/channels.hpp"
#include "engine/discovery.hpp"
#include "engine/lasting_errors.hpp"
#include "engine/life.hpp"
#include "engine/monitor_cases.hpp"
#include "engine/outage.hpp"
#include "engine/putting_back.hpp"
#include "engine/run_context.hpp"
#include "engine/tries.hpp"
#include "engine/trust.hpp"
#include "monitor/stopwatch.hpp"
#include "result/annotate.hpp"

namespace conform::engine {
namespace {

using result::CaseResult;
using result::Verdict;

/// A link that never stays up ends the run.
constexpr int most_outages_of_a_phase = 20;

/// The phases, in their order; what each of them does stands in a file of its own.
class Run {
 public:
  Run(can::Transport& transport, const device::Profile& profile, const scenario::Suite& suite,
      const scenario::Catalogue& catalogue, const RunOptions& options)
      : run_(transport, profile, catalogue, options),
        suite_(suite),
        life_(run_),
        outage_(run_, life_),
        putting_back_(run_),
        errors_(run_),
        budget_(options.budget, options.plan.worths),
        runner_(run_.session, catalogue, run_.live, options.strict, run_.may(scenario::Risk::config)) {
    run_.session.set_power_switch(life_.power_switch());
  }

  result::RunResult execute(can::Capture& capture) {
    const auto& profile = run_.profile;
    const auto begin = run_.recorder.now();
    budget_.begin(begin);
    auto ready = again_after_outages([this] { return prepare(); });
    make_plan();
    run_.recorder.observer().planned(out_, to_play());
    if (!ready) {
      abort_run(ready.error());
    } else if (!alive_) {
      abort_run({"nothing was heard of node " + std::to_string(profile.node.value()),
                 {},
                 "node-ID, bit rate, power?"});
    } else {
      run_cases();
      run_.recorder.begin_part(std::string(can::cases_are_over));
      if (!out_.aborted) putting_back_.finish();
      run_.recorder.end_part();
      if (!out_.aborted) out_.aborted = ended_early_;
    }
    if (auto note = budget_.note()) out_.notes.push_back(std::move(*note));
    life_.tell_restarts();
    life_.tell_tries();
    outage_.tell();
    judge_monitors();
    life_.tell_losses();
    out_.waivers = run_.waivers.uses(
        out_, [this](std::string_view pattern) { return names_a_case(suite_, pattern); },
        run_.options.strict);
    if (run_.options.measure) {
      const auto& frames = run_.recorder.capture().frames();
      out_.measurements = monitor::measure(frames, facts_of_run(run_.profile), life_.losses());
      out_.load = monitor::load_of(frames, run_.recorder.transport().info().bit_rate);
    }
    out_.elapsed = run_.recorder.now() - begin;
    if (run_.options.stop != nullptr) out_.signal = run_.options.stop->load();
    capture = std::move(run_.recorder.capture());
    return std::move(out_);
  }

 private:
  // ---- preparation
  // ------------------------------------------------------------------------------------------

  Result<void> prepare() {
    out_.device =
        run_.profile.name.empty() ? "node " + std::to_string(run_.profile.node.value()) : run_.profile.name;
    if (auto heard = run_.recorder.wait_until(run_.recorder.now() + run_.options.listen_first); !heard)
      return heard;
    auto liveness = probe(run_.session, life_.means());
    if (!liveness) return std::unexpected(liveness.error());
    alive_ = liveness->alive;
    mute_ = alive_ && !liveness->answers;
    if (!alive_) return {};
    if (mute_) {
      run_.note("heard " + liveness->heard);
      return {};
    }
    if (auto alone = life_.make_sure_it_is_alone(std::chrono::milliseconds(100)); !alone) return alone;
    if (run_.may(scenario::Risk::config)) {
      if (auto done = enter_pre_operational(run_); !done) return done;
    }
    if (auto done = survey(); !done) return done;
    if (auto done = putting_back_.look(budget_.look_until(0.5)); !done) return done;
    return errors_.look();
  }

  /// Which objects there are, and what the run tells of the device.
  Result<void> survey() {
    Survey seen;
    // A slow device, or one that leaves requests unanswered, would be looked at until the budget is gone.
    auto found = discover(run_.session, seen, life_.means(), budget_.look_until(1.0 / 3));
    if (!found) return std::unexpected(found.error());
    out_.dictionary = seen.rows(run_.session.known(), run_.profile);
    if (found->not_looked_at > 0)
      run_.note(std::to_string(found->not_looked_at) +
                " entries were not looked at, for the look at the device had a third of the --budget");
    if (!found->silent.empty()) {
      std::vector<std::string> names;
      for (const auto object : found->silent) names.push_back(to_string(object));
      run_.note("requests for " + join(names, ", ") + " are not answered");
    }
    if (auto alone = life_.note_restarts(); !alone) return alone;
    const bool told_how =
        std::ranges::any_of(run_.profile.errors, [](const auto& error) { return error.raise.has_value(); });
    if (run_.may(scenario::Risk::config) && !run_.may(scenario::Risk::motion) && !told_how) {
      run_.note(
          "no error was raised: the device profile tells no way (errors:), and the heartbeat of another node that stays "
          "away needs --allow motion");
    }
    auto properties = device_properties(run_.session);
    if (!properties) return std::unexpected(properties.error());
    out_.properties = std::move(*properties);
    for (const auto& property : out_.properties) {
      if (property.name == "dut.name" && run_.profile.name.empty())
        out_.device += " (" + property.value + ")";
    }
    return {};
  }

  void make_plan() {
    plan_ = plan(suite_, run_.catalogue, run_.session.known(), run_.options.plan);
    // Where nothing was heard of the device, nobody knows what it has.
    if (alive_)
      std::ranges::move(named_but_absent(suite_, run_.catalogue, run_.session.known(), run_.options.plan),
                        std::back_inserter(plan_));
    for (const auto& planned : plan_) out_.cases.push_back(planned_result(planned, run_.catalogue));
    plan_monitors(run_.monitors, run_.catalogue, out_);
    describe_requirements(run_.catalogue, out_);
  }

  /// Of each case of the result.
  std::vector<bool> to_play() const {
    std::vector<bool> out(out_.cases.size(), false);
    for (std::size_t i = 0; i < plan_.size(); ++i)
      out[i] = plan_[i].held_back.empty() && plan_[i].not_applicable.empty() && plan_[i].absent.empty();
    return out;
  }

  void abort_run(const Error& error) {
    out_.aborted = error.what == stopped ? "stopped by the user" : error.text();
  }

  // ---- the cases
  // --------------------------------------------------------------------------------------------

  void run_cases() {
    for (std::size_t i = 0; i < plan_.size(); ++i) {
      auto& result = out_.cases[i];
      const auto& scenario = *plan_[i].scenario;
      if (!plan_[i].held_back.empty() || !plan_[i].not_applicable.empty()) {
        result.verdict = Verdict::not_applicable;
        result.reason = plan_[i].held_back.empty() ? plan_[i].not_applicable : plan_[i].held_back;
        result.wants = plan_[i].wants;
        end_unplayed(result, i);
        continue;
      }
      if (!plan_[i].absent.empty()) {
        result.verdict = Verdict::inconclusive;
        result.reason = plan_[i].absent;
        end_unplayed(result, i);
        continue;
      }
      if (mute_ && !scenario.basic) continue;
      if (const auto* broken = channels_.broken_for(scenario)) {
        // It costs no bus time: whatever came would say nothing.
        result.verdict = broken->absent ? Verdict::not_applicable : Verdict::inconclusive;
        result.rests_on = broken->requirement;
        result.reason = "rests on " + broken->requirement + ", which failed in " + broken->in;
        end_unplayed(result, i);
        continue;
      }
      if (!budget_.admits(result.name(), run_.recorder.now())) {
        budget_.left_out();
        result.verdict = Verdict::not_applicable;
        result.reason = budget_.why();
        result.wants = {{"option", std::string(result::longer_budget)}};
        end_unplayed(result, i);
        continue;
      }
      run_.recorder.observer().case_begun(out_, i);
      const auto begun = run_.recorder.now();
      auto done = run_of_sample(plan_[i], result);
      budget_.took(result.name(), run_.recorder.now() - begun);
      channels_.note(scenario, result);
      run_.recorder.observer().case_ended(out_, i);
      if (!done) {
        abort_run(done.error());
        break;
      }
      if (fell_silent_) {
        abort_run(*fell_silent_);
        break;
      }
      if (run_.options.fail_fast && result.verdict == Verdict::fail) {
        ended_early_ = "at the first failure";
        break;
      }
    }
    if (mute_) {
      abort_run({"the device is there, but its default SDO server does not answer",
                 {},
                 "only what needs no answer was judged"});
    }
  }

  void end_unplayed(CaseResult& result, std::size_t index) {
    result.finished = true;
    result.begin = result.end = run_.recorder.now();
    run_.recorder.observer().case_ended(out_, index);
  }

  Result<void> reach_start(const scenario::Scenario& scenario) {
    const auto before = run_.recorder.capture().size();
    if (auto ready = reach_baseline(run_, scenario); !ready) return ready;
    if (run_.may(scenario::Risk::config)) putting_back_.after_resets();
    if (auto calm = errors_.let_end(before); !calm) return calm;
    life_.note_losses();
    return life_.note_restarts();
  }

  /// What does not apply to the object that was drawn is judged of another one: whoever takes a sample wants
  /// a verdict. Where it applies to none of them the first one says why.
  Result<void> run_of_sample(const PlannedCase& planned, CaseResult& result) {
    auto done = run_case(planned, result);
    std::optional<CaseResult> first;
    for (const auto& object : planned.stand_ins) {
      if (!done || fell_silent_ || !is_left_out_for_its_object(result)) return done;
      if (!first) first = result;
      const auto other = planned.of(object);
      result = planned_result(other, run_.catalogue);
      done = run_case(other, result);
    }
    if (done && !fell_silent_ && first && result.verdict == Verdict::not_applicable) result = *first;
    return done;
  }

  /// Whether the case did not apply for what the object is, so that it may apply to another one.
  [[nodiscard]] bool is_left_out_for_its_object(const CaseResult& result) const {
    if (result.verdict != Verdict::not_applicable) return false;
    return runner_.entered_steps() ||
           result.reason.contains(result.instance.substr(0, result.instance.find(':')));
  }

  Result<void> run_case(const PlannedCase& planned, CaseResult& result) {
    const auto fresh = result;
    Repeats repeats(run_.options.repeat);
    do {
      result = fresh;
      if (auto done = run_until_trusted(planned, result); !done) return done;
    } while (!fell_silent_ && repeats.again(result));
    if (!fell_silent_) result = repeats.outcome();
    run_.waivers.apply(result);
    return {};
  }

  /// Once, and again as long as the host was late for it.
  Result<void> run_until_trusted(const PlannedCase& planned, CaseResult& result) {
    const auto fresh = result;
    Tries tries;
    for (;; result = fresh) {
      auto trouble = try_case(planned, result);
      if (!trouble) return std::unexpected(trouble.error());
      if (!tries.again(result, *trouble) || fell_silent_) break;
    }
    result = tries.outcome();
    if (!result.tried.empty()) life_.tried_again(result);
    return {};
  }

  void begin_part(const CaseResult& result, can::CasePart part) {
    if (run_.recorder.tells_parts())
      run_.recorder.begin_part(can::to_comment({.name = result.name(), .part = part}));
  }

  /// Once. What befell the host meanwhile, if it matters.
  Result<std::optional<HostTrouble>> try_case(const PlannedCase& planned, CaseResult& result) {
    auto& recorder = run_.recorder;
    const auto first = recorder.capture().size();
    begin_part(result, can::CasePart::preparation);
    // The case has not begun: an outage takes nothing from it.
    auto ready = again_after_outages([&] { return reach_start(*planned.scenario); });
    recorder.end_part();
    if (!ready) {
      result.reason = "not run: " + ready.error().text();
      // A reset may have brought back what cases before this one wrote.
      putting_back_.after_fault({}, false);
      return std::unexpected(ready.error());
    }
    result.begin = recorder.now();
    result.first_frame = recorder.capture().size();
    const auto health = recorder.transport().health();
    recorder.set_losses(health.frames_dropped);
    (void)recorder.take_lateness();
    auto ran = runner_.run(planned, result);
    const bool entered = runner_.entered_steps();
    result.end_frame = recorder.capture().size();
    life_.note_losses();
    result.end = recorder.now();
    const auto lateness = recorder.take_lateness();
    begin_part(result, can::CasePart::putting_back);
    if (ran) ran = after_case(result);
    if (!ran) {
      // The environment failed in the middle: nothing of this case counts as passed or failed.
      withdraw(result, vanished_ ? life_.last_heard() : 0);
      result.reason =
          ran.error().what == stopped ? "stopped by the user before the case ended" : ran.error().text();
      std::function<Result<void>()> clean_up;
      if (entered) clean_up = [&] { return runner_.clean_up(*planned.scenario); };
      const bool goes_on = !vanished_ && come_back_after_fault(clean_up);
      if (!goes_on) putting_back_.after_fault(clean_up, false);
      recorder.end_part();
      if (!goes_on) return std::unexpected(ran.error());
      result.finished = true;
      return std::nullopt;
    }
    recorder.stop_producing("");
    recorder.end_part();
    result.finished = true;
    const bool other_client =
        run_.session.channel().has_other_client(result.first_frame, recorder.capture().size());
    auto trouble = trouble_of(health, recorder.transport().health(), lateness, other_client);
    if (!trouble)
      trouble = machine_trouble(recorder.transport().info(), recorder.latest_late_waking(), result.begin);
    if (trouble && trouble->passes_by && recorder.transport().info().is_virtual) life_.note_late(first);
    return trouble;
  }

  /// A phase that judges nothing, once more behind each outage that ended it.
  template <typename Phase>
  Result<void> again_after_outages(const Phase& phase) {
    auto done = phase();
    for (int i = 0; !done && i < most_outages_of_a_phase && come_back_after_fault({}); ++i) done = phase();
    return done;
  }

  /// After a fault that ended a case: waits for a bus that went away, and puts back what the case has
  /// changed. True: the run goes on with the next case.
  bool come_back_after_fault(const std::function<Result<void>()>& clean_up) {
    while (outage_.is_over()) {
      putting_back_.after_fault(clean_up, true);
      if (!run_.recorder.fault()) return true;
    }
    return false;
  }

  /// Makes sure that the device is still there and the same, and puts everything back.
  Result<void> after_case(CaseResult& result) {
    // A device that watches would miss us before its watch is taken back, and may stop for it (1029h).
    run_.recorder.stop_producing_but_life_signs();
    const bool in_doubt = result.verdict == Verdict::fail || result.verdict == Verdict::inconclusive;
    if (run_.session.silence_seen() || in_doubt) {
      auto life = still_there(result);
      if (!life) return std::unexpected(life.error());
      if (*life == Alive::there) {
        putting_back_.give_up("the SDO server does not answer");
        return {};
      }
    }
    if (auto judged = life_.judge_restarts(result, runner_); !judged) return judged;
    if (auto done = putting_back_.after_case(result); !done) return done;
    return errors_.end_those_of(result);
  }

  /// After a silence or a failure. A device that is gone is an error of the run.
  Result<Alive> still_there(const CaseResult& result) {
    if (mute_) return Alive::there;
    auto revival = look_for_life(run_.session, life_.means());
    if (!revival) return std::unexpected(revival.error());
    if (revival->was_reset) run_.note("the device had to be reset because it did not answer any more");
    if (revival->life == Alive::there) {
      // It is there and violates the rule under test by its silence; what would come next has nothing to ask.
      fell_silent_ = Error{"since " + result.name() + " the SDO server does not answer", {}, revival->tried};
    } else if (revival->life == Alive::gone) {
      vanished_ = true;
      return fail("the device vanished during " + result.name(), {}, revival->tried);
    } else if (auto alone = life_.make_sure_it_is_alone(std::chrono::milliseconds(20)); !alone) {
      return std::unexpected(alone.error());
    }
    return revival->life;
  }

  // ---- the end
  // ----------------------------------------------------------------------------------------------

  /// The monitors see the whole trace, also of a run that stopped early. A device that was never heard leaves
  /// them nothing to do.
  void judge_monitors() {
    const auto count = run_.monitors.size();
    if (count == 0 || !alive_) return;
    life_.note_losses();
    const auto& frames = run_.recorder.capture().frames();
    run_.live.follow(frames);
    conclude_trace(run_.live.watch(), frames,
                   {run_.monitors, run_.profile, run_.catalogue, run_.waivers, run_.options.strict},
                   life_.losses(), life_.late(), out_);
    // The preparation is no test of anything, unless only monitors were asked for.
    const auto scenarios = std::span(out_.cases).first(plan_.size());
    const auto was_run = [](const CaseResult& each) { return each.first_frame < each.end_frame; };
    if (out_.aborted && !plan_.empty() && std::ranges::none_of(scenarios, was_run))
      withdraw_passes(std::span(out_.cases).last(count), "the run stopped before any scenario");
    for (auto i = out_.cases.size() - count; i < out_.cases.size(); ++i)
      run_.recorder.observer().case_ended(out_, i);
  }

  RunContext run_;
  const scenario::Suite& suite_;
  result::RunResult& out_ = run_.out;
  Life life_;
  Outage outage_;
  PuttingBack putting_back_;
  LastingErrors errors_;
  Budget budget_;
  CaseRunner runner_;
  Channels channels_;
  std::vector<PlannedCase> plan_;
  bool alive_ = false;
  bool vanished_ = false;
  bool mute_ = false;                       ///< alive, but without a single SDO answer
  std::optional<Error> fell_silent_;        ///< during the run
  std::optional<std::string> ended_early_;  ///< by what the user asked for
};

}  // namespace

result::RunResult run(can::Transport& transport, const device::Profile& profile, const scenario::Suite& suite,
                      const scenario::Catalogue& catalogue, const RunOptions& options,
                      can::Capture& capture) {
  Run run(transport, profile, suite, catalogue, options);
  auto out = run.execute(capture);
  result::annotate(capture, out);
  return out;
}

}  // namespace conform::engine
