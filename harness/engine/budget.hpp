// SPDX-License-Identifier: Apache-2.0
// How much of a run fits into the time there is for it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/time.hpp"
#include "result/worth.hpp"

namespace conform::engine {

/// Cases are asked about in the order in which they are played. What to expect of a case is known from the
/// reference node; how much longer this device takes is learnt from the cases it has played.
class Budget {
 public:
  /// Without `total` everything fits. `worths` may be null, and outlives this.
  Budget(std::optional<Duration> total, const result::Worths* worths) : total_(total), worths_(worths) {}

  /// The time runs from here.
  void begin(BusTime now) { begin_ = now; }
  /// When the look at the device before the first case has had its part, `part` of the whole.
  [[nodiscard]] std::optional<BusTime> look_until(double part) const;
  /// Whether the case will have ended in time.
  [[nodiscard]] bool admits(std::string_view name, BusTime now) const;
  /// It was played.
  void took(std::string_view name, Duration time);
  /// It was left out.
  void left_out() { ++left_out_; }

  /// "left out: does not fit into --budget 60 s"
  [[nodiscard]] std::string why() const;
  /// What to tell about the run; nothing where nothing was left out.
  [[nodiscard]] std::optional<std::string> note() const;

 private:
  std::optional<Duration> total_;
  const result::Worths* worths_;
  BusTime begin_;
  result::Pace pace_;
  std::size_t left_out_ = 0;
};

}  // namespace conform::engine
