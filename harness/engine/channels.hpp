// SPDX-License-Identifier: Apache-2.0
// Which observation channels have failed in this run (docs/decisions/0003-what-a-verdict-rests-on.md).
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "result/run_result.hpp"
#include "scenario/scenario.hpp"

namespace conform::engine {

class Channels {
 public:
  /// A channel that failed, with the requirement that says so and the case.
  struct Broken {
    std::string requirement, in;
    /// The device lacks the object that is looked through: what rests on it does not apply. What else is
    /// wrong with a channel leaves open what would have been seen.
    bool absent = false;
  };

  /// nullptr: whatever the scenario rests on holds, as far as is known.
  [[nodiscard]] const Broken* broken_for(const scenario::Scenario& scenario) const;
  /// Learns from the result of a scenario that establishes channels.
  void note(const scenario::Scenario& scenario, const result::CaseResult& result);

 private:
  std::map<std::string_view, Broken> broken_;
};

}  // namespace conform::engine
