// SPDX-License-Identifier: Apache-2.0
// What is different between two runs: of two builds, two devices, two versions of the tool. What merely
// jitters (times, counts of frames, values that a device changes by itself, which objects a sample drew) is
// none.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "result/causes.hpp"
#include "result/compare_observed.hpp"
#include "result/compare_times.hpp"
#include "result/run_result.hpp"

namespace conform::result {

/// A cause of the new run, some findings of which the old run does not have, or has as warnings.
struct NewCause {
  Cause cause;
  std::vector<Place> fresh;         ///< these findings; the one to tell first is the first
  Verdict verdict = Verdict::fail;  ///< the worst of them
  /// The old run has others of its findings: it shows in more places than before.
  [[nodiscard]] bool has_spread() const { return fresh.size() < cause.findings.size(); }
};

/// A cause of the old run, findings of which the new run judged again, and better.
struct GoneCause {
  Cause cause;
  std::size_t mended = 0;  ///< findings that are gone
  std::size_t left = 0;    ///< findings that are there still, or could not be judged again
};

/// A requirement with another verdict than before.
struct Turn {
  std::string requirement;
  std::optional<Verdict> before, after;  ///< the worst of its cases; none: no branch that was taken judges it
  const CaseResult* where = nullptr;     ///< a case of the new run that shows it
};

/// Points into both runs.
struct Comparison {
  const RunResult* before = nullptr;
  const RunResult* after = nullptr;

  std::vector<NewCause> new_causes;  ///< failures first, whole causes before those that have spread
  std::vector<GoneCause> gone_causes;
  std::size_t known_failures = 0;  ///< causes of the new run with a failure that the old run has as well

  std::vector<Turn> worse, better;  ///< judged by both
  std::vector<Turn> lost;           ///< judged by the old run only: not applicable any more, or not decided
  std::vector<Turn> gained;         ///< judged by the new run only
  /// Requirements that no case of the other run is about: a selection, or another version of the suites.
  std::vector<std::string> only_in_old, only_in_new;

  std::vector<ObservedChange> observed;  ///< another answer, whatever was judged of it
  std::vector<ValueChange> identity;     ///< properties dut.*
  std::vector<EntryChange> entries;      ///< of the dictionary
  std::vector<InstancesChange> instances;
  std::vector<TimesChange> times;
  std::vector<ValueChange> circumstances;  ///< tool, suites, seed, bus: no difference of the device
  std::vector<std::string> remarks;        ///< why less is compared than it seems

  /// Requirements that were judged and now could not be: the host, the bus, or a precondition.
  [[nodiscard]] std::size_t undecided() const;
  /// Nothing but circumstances, and what may be values of the process.
  [[nodiscard]] bool is_same() const;
};

[[nodiscard]] Comparison compare(const RunResult& before, const RunResult& after);

/// 0 the same, or better; 1 a new failure (`strict`: or a new warning); 3 no new failure, but something that
/// was judged could not be judged.
[[nodiscard]] int exit_code(const Comparison& comparison, bool strict);

}  // namespace conform::result
