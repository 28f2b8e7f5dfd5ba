// SPDX-License-Identifier: Apache-2.0
#include "steps/timing.hpp"

#include <algorithm>
#include <optional>

#include "base/check.hpp"

namespace conform::steps {

Distances distances_of(std::span<const BusTime> frames, BusTime end) {
  CONFORM_CHECK(!frames.empty());
  Distances out;
  out.longest = std::max(Duration{}, end - frames.back());
  if (frames.size() < 2) return out;
  out.shortest = Duration::max();
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const auto gap = frames[i] - frames[i - 1];
    out.shortest = std::min(out.shortest, gap);
    out.longest = std::max(out.longest, gap);
  }
  out.mean = (frames.back() - frames.front()) / static_cast<Duration::rep>(frames.size() - 1);
  return out;
}

Answers answers_of(std::span<const BusTime> stimuli, std::span<const BusTime> frames) {
  CONFORM_CHECK(!stimuli.empty());
  Answers out;
  std::optional<std::size_t> last;  // the stimulus that was answered last
  for (const auto frame : frames) {
    const auto later = std::ranges::upper_bound(stimuli, frame);
    if (later == stimuli.begin()) {
      ++out.extra;
      continue;
    }
    const auto number = static_cast<std::size_t>(later - stimuli.begin()) - 1;
    if (last == number) {
      ++out.extra;
      continue;
    }
    if (!last) {
      out.skipped = out.missed = number;
      out.longest = number + 1;
    } else {
      const auto distance = number - *last;
      out.missed += distance - 1;
      out.shortest = out.shortest == 0 ? distance : std::min(out.shortest, distance);
      out.longest = std::max(out.longest, distance);
    }
    out.latencies.push_back(frame - stimuli[number]);
    last = number;
  }
  const auto behind = last ? stimuli.size() - 1 - *last : stimuli.size();
  out.missed += behind;
  if (!last) out.skipped = behind;
  if (behind > 0 || !last) out.longest = std::max(out.longest, behind + 1);
  std::ranges::sort(out.latencies);
  return out;
}

}  // namespace conform::steps
