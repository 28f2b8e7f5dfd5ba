// SPDX-License-Identifier: Apache-2.0
// The way in: every frame of the bus passes here before a service sees it. Filters say which frames reach the
// services, how they look, and may keep one for later or bring one of their own.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "base/time.hpp"
#include "can/frame.hpp"

namespace refnode {

class Inbox {
 public:
  using Frame = conform::can::Frame;
  using BusTime = conform::BusTime;
  /// Gets the frames that a received one has led to so far: at first that one alone.
  using Filter = std::function<void(std::vector<Frame>&)>;
  using Dispatch = std::function<void(const Frame&)>;

  void add_filter(Filter filter) { filters_.push_back(std::move(filter)); }
  /// Where frames go that have passed.
  void attach(Dispatch dispatch) { dispatch_ = std::move(dispatch); }

  void receive(const Frame& frame) {
    if (filters_.empty()) return dispatch_(frame);
    std::vector<Frame> frames{frame};
    for (const Filter& filter : filters_) filter(frames);
    for (const Frame& each : frames) dispatch_(each);
  }

  /// The services will see this frame then, unless a reset comes before.
  void put(const Frame& frame, BusTime at) { later_.emplace(at, frame); }
  /// The same where there is room for one frame of each CAN-ID: the newest.
  void put_newest(const Frame& frame, BusTime at) {
    const auto same = std::ranges::find_if(later_, [&](const auto& waiting) {
      return waiting.second.id == frame.id && waiting.second.remote == frame.remote &&
             waiting.second.extended == frame.extended;
    });
    if (same == later_.end()) return put(frame, at);
    same->second = frame;
  }
  void on_time(BusTime now) {
    while (!later_.empty() && later_.begin()->first <= now) {
      const Frame frame = later_.begin()->second;
      later_.erase(later_.begin());
      dispatch_(frame);
    }
  }
  [[nodiscard]] std::optional<BusTime> next_wakeup() const {
    return later_.empty() ? std::nullopt : std::optional(later_.begin()->first);
  }
  /// Of the past nothing is left after a reset.
  void clear() { later_.clear(); }

 private:
  std::vector<Filter> filters_;
  Dispatch dispatch_;
  std::multimap<BusTime, Frame> later_;
};

}  // namespace refnode
