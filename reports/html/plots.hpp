// SPDX-License-Identifier: Apache-2.0
// Drawings of what was measured: made by us from the samples, as SVG, with the same said in words beside
// them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/html/book.hpp"
#include "result/run_result.hpp"

namespace conform::reports::html {

struct Limits {
  std::optional<Duration> nominal, least, most;
  [[nodiscard]] bool hold(Duration value) const {
    return (!least || value >= *least) && (!most || value <= *most);
  }
};

/// What of them is drawn: evenly taken, but the longest ones always, they are what one looks for.
[[nodiscard]] std::vector<result::Sample> thinned(std::vector<result::Sample> samples);

/// Each sample over the time of the run, and beside it, on the same scale, how many there are of each length.
/// The limits go through both. `words` says what it shows, for who cannot see it.
[[nodiscard]] std::string strip_plot(const Book& book, std::string_view words,
                                     const std::vector<result::Sample>& samples, const Limits& limits,
                                     BusTime begin, BusTime end);

/// Two series on one scale: each sample over the time of its run, the old ones to the left, and beside them
/// back to back how many there are of each length. Lines mark the medians, or where nine of ten lie.
[[nodiscard]] std::string pair_plot(const Book& book, std::string_view words,
                                    const std::vector<result::Sample>& before,
                                    const std::vector<result::Sample>& after, bool is_spread);

/// Shortest, mean and longest on a common scale from nothing to `scale`: one row of a table.
[[nodiscard]] std::string range_plot(const result::Measurement& one, Duration scale);

/// A value for each stretch of time: the load of the bus.
[[nodiscard]] std::string step_plot(const Book& book, std::string_view words,
                                    const std::vector<BusTime>& from, const std::vector<double>& values,
                                    Duration span, std::string_view unit);

/// A bar of a length: one row of a table.
[[nodiscard]] std::string length_bar(double share);

}  // namespace conform::reports::html
