// SPDX-License-Identifier: Apache-2.0
#include "engine/budget.hpp"

#include <fmt/format.h>

#include "base/text.hpp"

#include <algorithm>

namespace conform::engine {
std::optional<BusTime> Budget::look_until(double part) const {
  if (!total_) return std::nullopt;
  return begin_ + std::chrono::duration_cast<Duration>(part * *total_);
}

bool Budget::admits(std::string_view name, BusTime now) const {
  if (!total_ || worths_ == nullptr) return true;
  return (now - begin_) + pace_.of(worths_->takes(name)) <= *total_;
}

void Budget::took(std::string_view name, Duration time) {
  if (worths_ != nullptr) pace_.took(worths_->takes(name), time);
}

std::string Budget::why() const {
  return "left out: does not fit into --budget " + to_string(total_.value_or(Duration{}));
}

std::optional<std::string> Budget::note() const {
  if (left_out_ == 0) return std::nullopt;
  return fmt::format(
      "{} {} left out to end within --budget {}: the run looks for what is found soonest and is no proof "
      "that the rest conforms",
      left_out_, left_out_ == 1 ? "case was" : "cases were", to_string(*total_));
}

}  // namespace conform::engine
