// SPDX-License-Identifier: Apache-2.0
// Values to places on a drawing, and round numbers to mark them with.
#pragma once

#include <vector>

namespace conform::reports::html {

class Axis {
 public:
  /// Maps `low` to `from` and `high` to `to`; a range of nothing is widened, so that there is always a scale.
  Axis(double low, double high, double from, double to);
  [[nodiscard]] double at(double value) const;
  /// About `wanted` round values between low and high.
  [[nodiscard]] std::vector<double> ticks(int wanted) const;

 private:
  double low_, high_, from_, to_;
};

}  // namespace conform::reports::html
