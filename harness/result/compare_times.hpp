// SPDX-License-Identifier: Apache-2.0
// Whether two runs measured other times of a device. A test says how sure that is; with many samples it finds
// differences that nobody cares for, so the difference must be large as well, and larger than what a busy
// host adds.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "result/run_result.hpp"

namespace conform::result {

/// Two series by the test of Mann and Whitney.
struct RankTest {
  double p = 1.0;       ///< how likely so great a difference is by chance; two-sided, ties counted
  double longer = 0.5;  ///< share of all pairs in which the second one is the longer; ties count half
};
[[nodiscard]] RankTest rank_test(std::span<const Duration> first, std::span<const Duration> second);

/// The value below which `share` of the samples lie; `sorted` is not empty.
[[nodiscard]] Duration quantile(std::span<const Duration> sorted, double share);

struct TimesChange {
  std::string kind, of;    ///< as in Measurement; `of` is empty where all of the kind are longer or shorter
  bool is_spread = false;  ///< the median is the same, but the times scatter more or less than before
  Duration before{}, after{};  ///< medians; where it is the spread, the range that holds 9 of 10
  std::size_t samples_before = 0, samples_after = 0;
  double p = 1.0;       ///< corrected for the number of series that were compared
  double longer = 0.5;  ///< share of pairs in which the new one is the longer; of a spread: farther off
};

[[nodiscard]] std::vector<TimesChange> times_changes(const RunResult& before, const RunResult& after);

/// The samples behind a change, of both runs: of one series, or of all of its kind that both runs have enough
/// of. In the order of the measurements.
struct TimesSeries {
  std::vector<Sample> before, after;
};
[[nodiscard]] TimesSeries series_of(const TimesChange& change, const RunResult& before,
                                    const RunResult& after);

}  // namespace conform::result
