// SPDX-License-Identifier: Apache-2.0
// How known mistakes show: what a run against each defect of the reference node blames, and which of them a
// cause of another run looks like. It decides no verdict: an engineer hears a mistake in words that somebody
// made before.
#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "result/causes.hpp"
#include "result/run_result.hpp"

namespace conform::result {

/// What a cause shows: which rules it breaks, and how each of them is broken.
struct Footprint {
  std::string lead;  ///< the requirement that the cause is told with
  /// Requirement and deviation of each finding (Finding::deviation, without values and objects), so that
  /// another device with the same mistake leaves the same ones.
  std::set<std::pair<std::string, std::string>> signs;
  /// Cases that show it, without their instances; empty where there are more than `few_cases`, as then they
  /// tell of nothing but the order of the run.
  std::set<std::string> cases;

  friend bool operator==(const Footprint&, const Footprint&) = default;
};
[[nodiscard]] Footprint footprint_of(const Cause& cause);

inline constexpr std::size_t few_cases = 12;

/// A known mistake.
struct Pattern {
  std::string name;     ///< id of the defect of the reference node
  std::string summary;  ///< what is wrong, one sentence without full stop
  Footprint footprint;  ///< of the heaviest cause of a run of the whole suite against it

  friend bool operator==(const Pattern&, const Pattern&) = default;
};

/// Two footprints are compared by the share of what both have in all that either has: of the requirements,
/// and of the signs. Below this they are not alike.
inline constexpr double least_alike = 0.6;
/// So many names say something; where more are equally alike, none does.
inline constexpr std::size_t most_alike = 3;

/// What a run could have shown.
struct Judged {
  std::set<std::string> requirements;
  std::set<std::string> cases;  ///< without their instances
};

/// How alike they are, 0 to 1, as far as both could be seen: rules that are not among `judged` are left out
/// of the pattern. 0 where they do not lead with the same requirement or are less alike than `least_alike`.
[[nodiscard]] double likeness(const Footprint& seen, const Footprint& pattern, const Judged& judged);

struct Alike {
  const Pattern* pattern = nullptr;
  double share = 0;  ///< as likeness() says
  double cases = 0;  ///< share of the cases that show both, which puts those in order that are equally alike
};
/// The patterns that are most like it, the best first: at most `most_alike` of them, and none where more than
/// these are equally alike. Points into `patterns`.
[[nodiscard]] std::vector<Alike> alike_to(const Footprint& seen, std::span<const Pattern> patterns,
                                          const Judged& judged);

/// The same for each cause of the run, in their order.
[[nodiscard]] std::vector<Likeness> likenesses_of(const RunResult& run, std::span<const Pattern> patterns);

}  // namespace conform::result
