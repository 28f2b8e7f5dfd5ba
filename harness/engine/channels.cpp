// SPDX-License-Identifier: Apache-2.0
#include "engine/channels.hpp"

#include <algorithm>

namespace conform::engine {

using result::Verdict;

const Channels::Broken* Channels::broken_for(const scenario::Scenario& scenario) const {
  for (const auto channel : scenario.rests_on) {
    const auto found = broken_.find(channel);
    if (found != broken_.end()) return &found->second;
  }
  return nullptr;
}

void Channels::note(const scenario::Scenario& scenario, const result::CaseResult& result) {
  for (const auto channel : scenario.establishes) {
    if (broken_.contains(channel)) continue;
    // Waived or not, it cannot be seen through.
    const auto failed = std::ranges::find_if(result.judgements, [](const result::Judgement& each) {
      return each.verdict == Verdict::fail || each.verdict == Verdict::waived;
    });
    if (failed != result.judgements.end()) {
      broken_[channel] = {failed->requirement, result.name(), channel == steps::channel::device_type};
    } else if (result.verdict == Verdict::inconclusive && !result.rests_on.empty()) {
      broken_[channel] = {result.rests_on, result.name(), false};
    }
  }
}

}  // namespace conform::engine
