// SPDX-License-Identifier: Apache-2.0
// The judgements of one case: each requirement with what its steps found, told once for all values of an
// `over`.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/witness.hpp"
#include "monitor/restarts.hpp"
#include "result/run_result.hpp"
#include "scenario/catalogue.hpp"

namespace conform::engine {

class CaseBook {
 public:
  CaseBook(RunSession& session, const scenario::Catalogue& catalogue, Witness& witness)
      : session_(session), catalogue_(catalogue), witness_(witness) {}

  /// Judgements go into `out` from here on.
  void open(result::CaseResult& out) {
    out_ = &out;
    offenders_.clear();
    value_.clear();
  }
  void record(const steps::Step& step, const std::string& requirement, const steps::Grade& given,
              const steps::Actual& actual);

  /// The value of an `over` that is tried; not empty: inside one.
  [[nodiscard]] const std::string& value() const { return value_; }
  void set_value(std::string value) { value_ = std::move(value); }
  /// Tells as one what was found with several values. `why`: not all of them were tried.
  void end_walk(const std::string& why);
  /// How much was found wrong with the values of an `over` so far.
  [[nodiscard]] std::size_t offences() const;

  [[nodiscard]] std::vector<result::Judgement> passes() const;
  /// What passed on a way that does not concern this device, and was still `open`, has not passed, unless it
  /// had `before`. What failed or warned stays.
  void withdraw_passes(const std::vector<std::string>& open, const std::vector<result::Judgement>& before);

  /// The verdict of the case. `stopped_because` not empty: what the case could have judged and did not reach
  /// is open and not passed; `open`: nor is what was judged in part only.
  void conclude(const std::string& stopped_because, const std::vector<std::string>& open);
  /// The device started in the middle of the case, and nobody had told it to. What was judged afterwards is
  /// open, except where the rule names crashes: `again` it restarted when it got the frames of `stimulus`
  /// once more.
  void judge_restart(result::CaseResult& out, std::size_t restart,
                     const std::optional<monitor::Stimulus>& stimulus, bool again, bool doubtful);

 private:
  /// Findings of one expectation over the values of an `over`, to be told as one.
  struct Offenders {
    const steps::Step* step = nullptr;
    std::string requirement;
    std::size_t finding = 0;
    std::vector<std::string> values;
    std::size_t judged = 0;
  };
  [[nodiscard]] result::Judgement& judgement(const std::string& requirement);
  [[nodiscard]] Offenders& offenders(const steps::Step& step, const std::string& requirement);

  RunSession& session_;
  const scenario::Catalogue& catalogue_;
  Witness& witness_;
  result::CaseResult* out_ = nullptr;
  std::string value_;
  std::vector<Offenders>
      offenders_;  ///< in the order of the first judgement: addresses must not decide any order
};

}  // namespace conform::engine
