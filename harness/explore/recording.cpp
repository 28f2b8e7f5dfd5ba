// SPDX-License-Identifier: Apache-2.0
#include "explore/recording.hpp"

#include <algorithm>
#include <utility>

namespace conform::explore {

Recorded::Recorded(const Recording& recording) : recording_(recording) { hear(recording_.booted); }

void Recorded::hear(BusTime until) {
  now_ = std::max(now_, until);
  for (; next_frame_ < recording_.unasked.size() && recording_.unasked[next_frame_].time <= until;
       ++next_frame_)
    came_.push_back(recording_.unasked[next_frame_]);
}

Answer Recorded::perform(const Action&, Duration) {
  if (next_answer_ == recording_.answers.size()) return {.kind = Answer::Kind::silence};
  hear(recording_.ends[next_answer_]);
  return recording_.answers[next_answer_++];
}

Duration Recorded::will_be_silent() const {
  if (next_answer_ == recording_.answers.size()) return {};
  const auto& answer = recording_.answers[next_answer_];
  return answer.kind == Answer::Kind::silence ? answer.taken : Duration{};
}

/// Behind its end nobody listened: it says nothing, and nothing of it is late.
void Recorded::run_until(BusTime time) { hear(std::min(time, recording_.end)); }

Recorder::Recorder(std::unique_ptr<Side> inner) : inner_(std::move(inner)) {
  take_down();
  recording_.booted = recording_.end;
}

void Recorder::take_down() {
  for (const auto& each : std::exchange(inner_->unasked(), {})) {
    recording_.unasked.push_back(each);
    came_.push_back(each);
  }
  recording_.end = inner_->now();
}

Answer Recorder::perform(const Action& action, Duration patience) {
  auto out = inner_->perform(action, patience);
  take_down();
  recording_.answers.push_back(out);
  recording_.ends.push_back(recording_.end);
  return out;
}

void Recorder::run_until(BusTime time) {
  inner_->run_until(time);
  take_down();
}

}  // namespace conform::explore
