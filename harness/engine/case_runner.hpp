// SPDX-License-Identifier: Apache-2.0
// Plays the steps of one case and judges what came.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/attribution.hpp"
#include "engine/given.hpp"
#include "engine/plan.hpp"
#include "engine/run_session.hpp"
#include "monitor/restarts.hpp"
#include "result/run_result.hpp"
#include "scenario/catalogue.hpp"

namespace conform::engine {

class CaseRunner {
 public:
  CaseRunner(RunSession& session, const scenario::Catalogue& catalogue, Attribution& attribution, bool strict,
             bool may_write)
      : session_(session),
        catalogue_(catalogue),
        givens_(session, may_write),
        attribution_(attribution),
        strict_(strict) {}

  /// Steps and cleanup; fills judgements, verdict and reason of `out`. Error: the environment failed; what
  /// was judged stays.
  [[nodiscard]] Result<void> run(const PlannedCase& planned, result::CaseResult& out);
  /// Whether the last case came as far as its steps, so that there is something to clean up.
  [[nodiscard]] bool entered_steps() const { return entered_steps_; }
  /// The device started in the middle of the case, and nobody had told it to. What was judged afterwards is
  /// open, except where the rule names crashes: `again` it restarted when it got the frames of `stimulus`
  /// once more.
  void judge_restart(result::CaseResult& out, std::size_t restart,
                     const std::optional<monitor::Stimulus>& stimulus, bool again, bool doubtful);
  /// The cleanup of a case that was stopped; a fault of the environment ends it.
  [[nodiscard]] Result<void> clean_up(const scenario::Scenario& scenario) {
    return run_cleanup(scenario.cleanup);
  }

 private:
  enum class Flow : std::uint8_t { go_on, next_value, stop };  // next_value: of the innermost `over`
  /// Findings of one expectation over the values of an `over`, to be told as one.
  struct Offenders {
    const steps::Step* step = nullptr;
    std::string requirement;
    std::size_t finding = 0;
    std::vector<std::string> values;
    std::size_t judged = 0;
  };
  using Steps = std::vector<steps::Step>;

  [[nodiscard]] Result<void> run_cleanup(const Steps& list);

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
  void record(const steps::Step& step, const std::string& requirement, const steps::Grade& grade,
              const steps::Actual& actual);
  /// Where the description tells of what a step is about, or that it does not; empty without a description.
  [[nodiscard]] std::string declared_at(const steps::Step& step, const steps::Actual& actual) const;
  [[nodiscard]] result::Finding make_finding(const steps::Step& step, const std::string& requirement,
                                             const steps::Grade& grade, const steps::Actual& actual);
  [[nodiscard]] std::vector<result::EvidenceFrame> evidence(std::size_t begin,
                                                            std::optional<std::size_t> decisive) const;
  [[nodiscard]] result::Judgement& judgement(const std::string& requirement);
  [[nodiscard]] Offenders& offenders(const steps::Step& step, const std::string& requirement);
  /// Ids that steps at or behind a place in the file would still have decided.
  void collect_open(const Steps& list, int from_line, std::vector<std::string>& out) const;
  /// A way that does not concern this device: what passed on it before and was still to be decided by this
  /// step or a later one has not passed. What failed or warned stays. Inside an `over` only the value ends,
  /// else the case.
  [[nodiscard]] Flow not_applicable(const steps::Step& step, const std::string& reason);
  [[nodiscard]] std::vector<result::Judgement> passes() const;
  void withdraw_passes(const Steps& list, const std::vector<result::Judgement>& before);
  /// What came breaks rules below the one that is judged: those have failed, and this one cannot be judged.
  [[nodiscard]] std::optional<std::string> rule_below(const std::string& requirement,
                                                      const steps::Actual& actual);
  /// A failure of a rule that only recommends is a warning, as everywhere.
  [[nodiscard]] result::Verdict capped(const std::string& requirement) const;
  [[nodiscard]] std::string_view level_of(const std::string& requirement) const;
  /// The grade of taking one of the ways of an `either`.
  [[nodiscard]] steps::Grade grade_of(const steps::Branch& branch, const std::string& requirement) const;
  void finish_walk();
  /// How much was found wrong with the values of an `over` so far.
  [[nodiscard]] std::size_t offences() const;
  void conclude();
  void explain_nothing_judged();

  RunSession& session_;
  const scenario::Catalogue& catalogue_;
  Givens givens_;
  Attribution& attribution_;
  bool strict_;
  result::CaseResult* out_ = nullptr;
  std::size_t step_begin_ = 0;
  std::string walk_value_;  ///< not empty: inside an `over`
  std::string walk_end_;    ///< why not all values of the `over` were tried
  int left_at_line_ = 0;    ///< of the step whose way does not concern this device
  std::vector<Offenders>
      offenders_;  ///< in the order of the first judgement: addresses must not decide any order
  std::optional<Multiplexer> instance_object_;  ///< the object a case of for_each is about
  std::string stopped_because_;
  std::vector<std::pair<const steps::Condition*, bool>> skipped_;  ///< of deciding steps that were left out
  std::vector<std::string> empty_walks_;  ///< each `over` that had nothing to walk over, in words
  bool entered_steps_ = false;
  bool timed_ = false;                      ///< something in this case has rested on time or on silence
  const steps::Step* outermost_ = nullptr;  ///< the step of the scenario's own list that runs
  const Steps* list_ = nullptr;             ///< that list
};

}  // namespace conform::engine
