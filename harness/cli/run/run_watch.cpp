// SPDX-License-Identifier: Apache-2.0
#include "cli/run/run_watch.hpp"

#include <algorithm>
#include <cstdio>

#include "cli/run/guardian.hpp"
#include "cli/run/terminal.hpp"

namespace conform::cli {

void RunWatch::recorded(const can::CapturedFrame& frame) {
  now_ = frame.time;
  if (!begin_) begin_ = now_;
  note_progress();
  reports_.recorded(frame);
}

void RunWatch::waited(BusTime now) {
  now_ = now;
  if (!begin_) begin_ = now_;
  note_progress();
  reports_.waited(now);
}

void RunWatch::planned(const result::RunResult& run, const std::vector<bool>& to_play) {
  if (console_.worths != nullptr) {
    for (std::size_t i = 0; i < run.cases.size(); ++i) {
      expected_.push_back(to_play[i] ? console_.worths->takes(run.cases[i].name()) : Duration{});
      to_come_ += expected_.back();
    }
  }
  if (journal_ == nullptr) return;
  auto whole = run;
  complete_(whole);
  journal_->planned(whole);
}

void RunWatch::case_begun(const result::RunResult& run, std::size_t index) {
  running_ = run.cases[index].name();
  if (journal_ != nullptr) journal_->case_begun(index, now_);
  if (!console_.live) return;
  case_begin_ = now_;
  print("\r\x1B[K" +
        reports::progress(index + 1, run.cases.size(), times(), running_, counts_, console_.style));
  std::fflush(stdout);
}

void RunWatch::case_ended(const result::RunResult& run, std::size_t index) {
  const auto& one = run.cases[index];
  counts_.add(one.verdict);
  if (index < expected_.size()) {
    if (!running_.empty()) pace_.took(expected_[index], now_ - case_begin_);
    to_come_ -= expected_[index];
  }
  running_.clear();
  reports_.flush();
  if (journal_ != nullptr) journal_->case_ended(index, one);
  const bool quiet_verdict =
      one.verdict == result::Verdict::pass || one.verdict == result::Verdict::not_applicable;
  if (console_.live) {
    if (!quiet_verdict) print("\r\x1B[K" + reports::case_line(one, console_.style) + "\n");
  } else if (!console_.quiet || !quiet_verdict) {
    print(reports::case_line(one, console_.style) + "\n");
  }
}

std::string RunWatch::times() const {
  if (expected_.empty() || !begin_) return "";
  const auto elapsed = now_ - *begin_;
  auto left = pace_.of(to_come_);
  if (console_.budget) left = std::clamp(*console_.budget - elapsed, Duration{}, left);
  return reports::clock_words(elapsed) + ", " + reports::about(left) + " left";
}

void RunWatch::changing(Multiplexer object, const Bytes& before) {
  const auto known = std::ranges::find(changes_, object, &result::Change::object);
  if (known == changes_.end()) {
    changes_.push_back({.object = object, .before = before, .during = running_});
  } else {
    known->put_back = false;
  }
  if (journal_ != nullptr) journal_->changing({object, before, running_.empty() ? "the run" : running_});
}

void RunWatch::commanding(Multiplexer object) {
  if (journal_ != nullptr) journal_->commanding(object);
}

void RunWatch::put_back(Multiplexer object, const Bytes& value) {
  const auto known = std::ranges::find(changes_, object, &result::Change::object);
  if (known != changes_.end() && known->before == value) known->put_back = true;
  if (journal_ != nullptr) journal_->put_back(object, value);
}

}  // namespace conform::cli
