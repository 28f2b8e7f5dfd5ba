// SPDX-License-Identifier: Apache-2.0
// What a step saw, as a finding: the frames around it, how it differs, where the description tells of it, and
// which rule below the judged one it breaks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/live_monitors.hpp"
#include "engine/run_session.hpp"
#include "result/run_result.hpp"
#include "scenario/catalogue.hpp"
#include "steps/step.hpp"

namespace conform::engine {

/// An answer that did not come, or that says that ours came too late.
[[nodiscard]] bool is_late(const steps::Actual& actual, const RunSession& session);

class Witness {
 public:
  Witness(RunSession& session, LiveMonitors& attribution) : session_(session), attribution_(attribution) {}

  /// `about`: the object a case of for_each is about.
  void begin_case(const result::CaseResult& result, std::optional<Multiplexer> about) {
    result_ = &result;
    about_ = about;
    walked_.reset();
    timed_ = false;
    done_.clear();
  }
  void begin_step() {
    step_begin_ = session_.capture().size();
    step_began_at_ = session_.now();
  }
  /// A step was carried out. `done()` and `forget()`: where the next value of a walk begins, nothing of the
  /// last one is left to tell.
  void note_done(const steps::Step& step) {
    if (step.action->acts()) done_.push_back(&step);
  }
  [[nodiscard]] std::size_t done() const { return done_.size(); }
  void forget(std::size_t from) { done_.resize(std::min(from, done_.size())); }
  /// The object that an `over` has come to.
  void set_walked(std::optional<Multiplexer> object) { walked_ = object; }
  [[nodiscard]] std::optional<Multiplexer> walked() const { return walked_; }
  /// From here on what the case finds has rested on time or on silence.
  void note_time() { timed_ = true; }

  [[nodiscard]] result::Finding finding(const steps::Step& step, const std::string& requirement,
                                        const steps::Grade& grade, const steps::Actual& actual);
  /// The frames around the decisive one; without one those before and behind the moment from which something
  /// was waited for, or else the last of the trace. With their meaning. `first_frame`: of the case, `begin`:
  /// of the step.
  [[nodiscard]] std::vector<result::EvidenceFrame> evidence(
      std::size_t first_frame, std::size_t begin, std::optional<std::size_t> decisive,
      const std::optional<result::Listening>& listened = {}) const;
  /// Where the description tells of what a step is about, or that it does not; empty without a description.
  [[nodiscard]] std::string declared_at(const steps::Step& step, const steps::Actual& actual) const;
  /// What came breaks rules below the one that is judged: those have failed, and this one cannot be judged.
  [[nodiscard]] std::optional<std::string> rule_below(const std::string& requirement,
                                                      const steps::Actual& actual,
                                                      const scenario::Catalogue& catalogue);

 private:
  /// When the step waited, where it tells, or how long nothing followed what it sent.
  [[nodiscard]] std::optional<result::Listening> listened(const steps::Actual& actual) const;
  /// The last steps before `deciding` that sent something, in words.
  [[nodiscard]] std::vector<std::string> prepared(const steps::Step& deciding) const;

  RunSession& session_;
  LiveMonitors& attribution_;
  const result::CaseResult* result_ = nullptr;
  std::optional<Multiplexer> about_, walked_;
  std::size_t step_begin_ = 0;
  BusTime step_began_at_{};
  bool timed_ = false;
  std::vector<const steps::Step*> done_;
};

}  // namespace conform::engine
