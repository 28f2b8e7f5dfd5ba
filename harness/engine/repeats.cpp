// SPDX-License-Identifier: Apache-2.0
#include "engine/repeats.hpp"

#include <fmt/format.h>

#include <utility>

namespace conform::engine {

using result::CaseResult;
using result::Verdict;

bool Repeats::again(CaseResult seen) {
  ++count_;
  ++verdicts_[seen.verdict];
  const auto verdict = seen.verdict;
  if (!worst_ || verdict > worst_->verdict) worst_ = std::move(seen);
  // What does not apply now will not apply a moment later.
  if (count_ >= wanted_.times || verdict == Verdict::not_applicable) return false;
  return !(wanted_.until_fail && verdict == Verdict::fail);
}

CaseResult Repeats::outcome() {
  auto out = std::move(*worst_);
  if (wanted_.times > 1 && out.verdict != Verdict::not_applicable) {
    std::string told =
        fmt::format("{} of {} times {}", verdicts_[out.verdict], count_, to_string(out.verdict));
    out.tried = out.tried.empty() ? told : told + "; " + out.tried;
  }
  return out;
}

}  // namespace conform::engine
