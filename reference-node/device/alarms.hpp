// SPDX-License-Identifier: Apache-2.0
// When the many of one kind are due: hundreds of PDOs, of which few have a timer running. The earliest time
// is kept, so that not all of them are asked behind each frame.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/time.hpp"

namespace refnode {

class Alarms {
  using BusTime = conform::BusTime;

 public:
  /// One of them; used like a time that may be missing. `alarms` outlives it.
  class Alarm {
   public:
    explicit Alarm(Alarms& alarms) : alarms_(&alarms), place_(alarms.times_.size()) {
      alarms.times_.push_back(never);
    }
    Alarm& operator=(BusTime at) {
      alarms_->set(place_, at);
      return *this;
    }
    void reset() { alarms_->set(place_, never); }
    [[nodiscard]] explicit operator bool() const { return alarms_->times_[place_] != never; }
    [[nodiscard]] BusTime operator*() const { return alarms_->times_[place_]; }

   private:
    Alarms* alarms_;
    std::size_t place_;
  };

  Alarms() = default;
  Alarms(const Alarms&) = delete;
  Alarms& operator=(const Alarms&) = delete;

  /// The earliest of all.
  [[nodiscard]] std::optional<BusTime> next() const {
    if (!first_) first_ = times_.empty() ? never : *std::ranges::min_element(times_);
    return *first_ == never ? std::nullopt : first_;
  }

 private:
  static constexpr BusTime never = BusTime::max();

  void set(std::size_t place, BusTime at) {
    const BusTime before = times_[place];
    times_[place] = at;
    if (first_ && before == *first_ && at > before) first_.reset();
    if (first_) first_ = std::min(*first_, at);
  }

  std::vector<BusTime> times_;
  mutable std::optional<BusTime> first_;  ///< nothing: to be looked for
};

}  // namespace refnode
