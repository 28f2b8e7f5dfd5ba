// SPDX-License-Identifier: Apache-2.0
// Which cases a run consists of: scenarios, expanded over for_each, filtered by selection and risk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "device/dictionary.hpp"
#include "result/run_result.hpp"
#include "result/worth.hpp"
#include "scenario/catalogue.hpp"
#include "scenario/loader.hpp"
#include "scenario/selection.hpp"

namespace conform::engine {

struct PlannedCase {
  const scenario::Scenario* scenario = nullptr;
  std::string instance;
  std::map<std::string, std::string, std::less<>> names;  ///< bound by for_each, as written
  std::string held_back;                                  ///< why it will not be run, or empty
  std::string not_applicable;                             ///< a query that found nothing
  std::vector<result::Want> wants;                        ///< what would make it run
  std::string absent;  ///< why a case that was asked for by name cannot be played: it stays open
  /// Of a sample: other objects of the query, in the order in which they stand in where the case does not
  /// apply to its own. No two cases have the same one.
  std::vector<std::string> stand_ins;

  /// The same case of another object.
  [[nodiscard]] PlannedCase of(const std::string& object) const;
};

/// One of several parts of a run that are played at the same time, on machines of their own.
struct Shard {
  std::size_t number = 1, of = 1;  ///< 1 <= number <= of
};

struct PlanOptions {
  scenario::Selection selection;
  scenario::Risk allowed = scenario::Risk::motion;
  std::uint64_t seed = 1;    ///< of the sample taken from long queries
  bool all_objects = false;  ///< no sampling
  bool slow = true;          ///< scenarios that take long on a real bus
  /// Ids of the only scenarios to take, in the order in which they are to run; empty: all, in the own order.
  std::vector<std::string> order;
  /// The most worth per time first; lives longer than the run. Null: not so.
  const result::Worths* worths = nullptr;
  /// Seed of a random order of all cases; a verdict must not depend on what ran before it.
  std::optional<std::uint64_t> shuffle;
  /// Names of the only cases to take, with their instances; nothing: all.
  std::optional<std::set<std::string>> only;
  /// Every n-th case of the plan, so that neighbours, which take about the same time, are spread.
  Shard shard;
};

/// In the order that is given, in a random one, by what cases are worth, or in that of the suite, basic
/// scenarios first, then read-only ones, then config, nvm and motion: what can do harm comes last.
[[nodiscard]] std::vector<PlannedCase> plan(const scenario::Suite& suite,
                                            const scenario::Catalogue& catalogue,
                                            const device::Dictionary& dictionary, const PlanOptions& options);

/// What is asked for by the name of an instance that this device does not have,
/// "…/read-only-refuses[2000h:07]". A run that left it out in silence would say that it passed. Of several
/// parts the first one tells.
[[nodiscard]] std::vector<PlannedCase> named_but_absent(const scenario::Suite& suite,
                                                        const scenario::Catalogue& catalogue,
                                                        const device::Dictionary& dictionary,
                                                        const PlanOptions& options);

/// The case as reports show it before it has run.
[[nodiscard]] result::CaseResult planned_result(const PlannedCase& planned,
                                                const scenario::Catalogue& catalogue);

}  // namespace conform::engine
