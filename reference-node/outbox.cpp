// SPDX-License-Identifier: Apache-2.0
#include "outbox.hpp"

namespace refnode {

void Outbox::send(const FilterContext& context, std::vector<Outgoing> frames, BusTime now) {
  for (const Filter& filter : filters_) filter(context, frames);
  for (const Outgoing& outgoing : frames) {
    if (outgoing.delay > Duration::zero()) {
      delayed_.emplace(now + outgoing.delay, outgoing.frame);
    } else if (sender_) {
      sender_(outgoing.frame);
    }
  }
}

void Outbox::on_time(BusTime now) {
  while (!delayed_.empty() && delayed_.begin()->first <= now) {
    const Frame frame = delayed_.begin()->second;
    delayed_.erase(delayed_.begin());
    if (sender_) sender_(frame);
  }
}

std::optional<BusTime> Outbox::next_wakeup() const {
  if (delayed_.empty()) return std::nullopt;
  return delayed_.begin()->first;
}

}  // namespace refnode
