// SPDX-License-Identifier: Apache-2.0
#include "reports/html/axis.hpp"

#include <algorithm>
#include <cmath>

namespace conform::reports::html {

Axis::Axis(double low, double high, double from, double to) : low_(low), high_(high), from_(from), to_(to) {
  if (high_ > low_) return;
  const double margin = std::max(std::abs(low_) * 0.1, 0.01);
  low_ -= margin;
  high_ += margin;
}

double Axis::at(double value) const {
  const double share = std::clamp((value - low_) / (high_ - low_), 0.0, 1.0);
  return from_ + share * (to_ - from_);
}

std::vector<double> Axis::ticks(int wanted) const {
  const double raw = (high_ - low_) / std::max(wanted, 1);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double share = raw / power;
  const double step = power * (share <= 1.5 ? 1 : share <= 3.5 ? 2 : share <= 7.5 ? 5 : 10);
  std::vector<double> out;
  // Counted and not summed up: rounding would not be seen in the last tick only.
  const auto first = static_cast<long long>(std::ceil(low_ / step - 1e-9));
  const auto last = static_cast<long long>(std::floor(high_ / step + 1e-9));
  for (long long i = first; i <= last && out.size() < 50; ++i) out.push_back(static_cast<double>(i) * step);
  return out;
}

}  // namespace conform::reports::html
