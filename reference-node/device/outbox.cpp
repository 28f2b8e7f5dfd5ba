// SPDX-License-Identifier: Apache-2.0
#include "device/outbox.hpp"

#include <utility>

namespace refnode {

void Outbox::send(const FilterContext& context, std::vector<Outgoing> frames, BusTime now) {
  FilterContext timed = context;
  timed.now = now;
  for (const Filter& filter : filters_) filter(timed, frames);
  for (const Outgoing& outgoing : frames) {
    if (outgoing.delay > Duration::zero()) {
      delayed_.emplace(now + outgoing.delay, outgoing);
    } else {
      hand_over(outgoing.frame, now);
    }
  }
}

void Outbox::hand_over(const Frame& frame, BusTime now) {
  if (!sender_) return;
  waiting_ = waiting(now) + 1;
  progress_ = now;
  sender_(frame);
}

void Outbox::on_transmitted(BusTime now) {
  if (waiting_ > 0) --waiting_;
  progress_ = now;
}

std::size_t Outbox::waiting(BusTime now) const { return now >= progress_ + patience ? 0 : waiting_; }

void Outbox::on_time(BusTime now) {
  while (!delayed_.empty() && delayed_.begin()->first <= now) {
    const Outgoing outgoing = std::move(delayed_.begin()->second);
    delayed_.erase(delayed_.begin());
    if (!outgoing.still_wanted || outgoing.still_wanted()) hand_over(outgoing.frame, now);
  }
}

std::optional<BusTime> Outbox::next_wakeup() const {
  if (delayed_.empty()) return std::nullopt;
  return delayed_.begin()->first;
}

}  // namespace refnode
