// SPDX-License-Identifier: Apache-2.0
// What two runs saw of a device that is no verdict: other answers, other entries, another identity.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "result/run_result.hpp"

namespace conform::result {

/// A step that came out otherwise.
struct ObservedChange {
  const CaseResult* where = nullptr;  ///< of the new run
  std::string requirement;
  std::string step;  ///< in words, of the new run
  std::string before, after;
};

/// A named value that is another one; empty: it was not there.
struct ValueChange {
  std::string name;
  std::string before, after;
};

/// A scenario that was played for other objects than before, although no sample was drawn.
struct InstancesChange {
  std::string id;
  std::vector<std::string> gone, added;  ///< instances
};

/// Deciding steps, and findings that both runs have, whose answer is of another kind or another abort code.
[[nodiscard]] std::vector<ObservedChange> observed_changes(const RunResult& before, const RunResult& after);
/// Entries of the communication profile that hold another value, as far as both runs looked at them in the
/// same way. What a device changes by itself (errors, clocks) is left out.
[[nodiscard]] std::vector<ValueChange> entry_changes(const RunResult& before, const RunResult& after);
[[nodiscard]] std::vector<InstancesChange> instance_changes(const RunResult& before, const RunResult& after);
/// Properties that begin with one of `prefixes`.
[[nodiscard]] std::vector<ValueChange> property_changes(const RunResult& before, const RunResult& after,
                                                        const std::vector<std::string>& prefixes);

}  // namespace conform::result
