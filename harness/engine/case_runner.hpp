// SPDX-License-Identifier: Apache-2.0
// Plays the steps of one case and judges what came.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "can/capture_marks.hpp"
#include "engine/case_book.hpp"
#include "engine/given.hpp"
#include "engine/plan.hpp"
#include "engine/run_session.hpp"
#include "engine/witness.hpp"
#include "monitor/restarts.hpp"
#include "result/run_result.hpp"
#include "scenario/catalogue.hpp"

namespace conform::engine {

class CaseRunner {
 public:
  CaseRunner(RunSession& session, const scenario::Catalogue& catalogue, LiveMonitors& attribution,
             bool strict, bool may_write)
      : session_(session),
        catalogue_(catalogue),
        givens_(session, may_write),
        witness_(session, attribution),
        book_(session, catalogue, witness_),
        strict_(strict) {}

  /// Steps and cleanup; fills judgements, verdict and reason of `out`. Error: the environment failed; what
  /// was judged stays.
  [[nodiscard]] Result<void> run(const PlannedCase& planned, result::CaseResult& out);
  /// Whether the last case came as far as its steps, so that there is something to clean up.
  [[nodiscard]] bool entered_steps() const { return entered_steps_; }
  /// See CaseBook::judge_restart().
  void judge_restart(result::CaseResult& out, std::size_t restart,
                     const std::optional<monitor::Stimulus>& stimulus, bool again, bool doubtful) {
    book_.judge_restart(out, restart, stimulus, again, doubtful);
  }
  /// The cleanup of a case that was stopped; a fault of the environment ends it.
  [[nodiscard]] Result<void> clean_up(const scenario::Scenario& scenario) {
    return run_cleanup(scenario.cleanup);
  }

 private:
  enum class Flow : std::uint8_t { go_on, next_value, stop };  // next_value: of the innermost `over`
  using Steps = std::vector<steps::Step>;

  [[nodiscard]] Result<void> run_cleanup(const Steps& list);
  [[nodiscard]] bool stores(const steps::Step& step) const;

  /// Carries out the action of a step; the frames of the capture tell of it.
  [[nodiscard]] Result<steps::Actual> act(const steps::Step& step, can::CasePart part);

  [[nodiscard]] Result<Flow> run_steps(const Steps& list);
  [[nodiscard]] Result<Flow> run_step(const steps::Step& step);
  [[nodiscard]] Result<Flow> run_walk(const steps::Step& step);
  [[nodiscard]] Result<Flow> run_branches(const steps::Step& step, const steps::Actual& actual);
  [[nodiscard]] Flow set_up_failed(const steps::Step& step, const steps::Actual& actual);
  [[nodiscard]] Result<Flow> judge(const steps::Step& step, const steps::Actual& actual);
  /// A name without a value, an entry that cannot be read: the scenario cannot go on, the device is not
  /// blamed.
  [[nodiscard]] Result<Flow> cannot_go_on(const steps::Step& step, const Error& error);
  [[nodiscard]] std::vector<std::string> checks_of(const steps::Step& step) const;
  /// Ids that steps at or behind a place in the file would still have decided.
  [[nodiscard]] std::vector<std::string> open_from(const Steps& list, int line) const;
  /// A way that does not concern this device: what passed on it before and was still to be decided by this
  /// step or a later one has not passed. What failed or warned stays. Inside an `over` only the value ends,
  /// else the case.
  [[nodiscard]] Flow not_applicable(const steps::Step& step, const std::string& reason);
  /// A failure of a rule that only recommends is a warning, as everywhere.
  [[nodiscard]] result::Verdict capped(const std::string& requirement) const;
  [[nodiscard]] std::string_view level_of(const std::string& requirement) const;
  /// The grade of taking one of the ways of an `either`.
  [[nodiscard]] steps::Grade grade_of(const steps::Branch& branch, const std::string& requirement) const;
  void conclude();
  void explain_nothing_judged();

  RunSession& session_;
  const scenario::Catalogue& catalogue_;
  Givens givens_;
  Witness witness_;
  CaseBook book_;
  bool strict_;
  result::CaseResult* out_ = nullptr;
  std::string walk_end_;  ///< why not all values of the `over` were tried
  int left_at_line_ = 0;  ///< of the step whose way does not concern this device
  std::string stopped_because_;
  std::vector<std::pair<const steps::Condition*, bool>> skipped_;  ///< of deciding steps that were left out
  std::vector<std::string> empty_walks_;  ///< each `over` that had nothing to walk over, in words
  bool entered_steps_ = false;
  std::size_t steps_done_ = 0, cleanups_done_ = 0;
  const steps::Step* outermost_ = nullptr;  ///< the step of the scenario's own list that runs
  const Steps* list_ = nullptr;             ///< that list
};

}  // namespace conform::engine
