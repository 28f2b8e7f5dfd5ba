// SPDX-License-Identifier: Apache-2.0
#include "monitor/monitor.hpp"

#include <algorithm>

namespace conform::monitor {

void Monitor::end(const Follower& follower) {
  on_end(follower);
  if (follower.others_heard()) {
    std::erase_if(violations_, [](const Violation& each) { return each.if_alone; });
    for (auto& tally : tallies_) {
      tally.judged -= tally.if_alone;
      tally.violated -= tally.if_alone;
      tally.if_alone = 0;
    }
  }
  std::vector<std::size_t> kept(tallies_.size());
  std::erase_if(violations_, [&](const Violation& each) { return ++kept[each.requirement] > most_kept; });
}

}  // namespace conform::monitor
