// SPDX-License-Identifier: Apache-2.0
#include "engine/live_monitors.hpp"

#include <algorithm>

#include "result/services.hpp"

namespace conform::engine {
namespace {

std::vector<const monitor::Rule*> watched(std::span<const monitor::Rule* const> chosen) {
  std::vector<const monitor::Rule*> out;
  for (const auto& rule : monitor::rules()) {
    if (!rule.unasked || std::ranges::find(chosen, &rule) != chosen.end()) out.push_back(&rule);
  }
  return out;
}

constexpr std::string_view reserved_bytes = "SDO-GEN-05";
constexpr std::string_view undefined_code = "SDO-ERR-05";

}  // namespace

LiveMonitors::LiveMonitors(const monitor::Facts& facts, std::span<const monitor::Rule* const> chosen)
    : watch_(facts, watched(chosen)) {
  for (const auto& each : watch_.monitors())
    violated_.emplace_back(each->rule().unasked ? 0 : each->tallies().size(), 0);
}

void LiveMonitors::follow(std::span<const can::CapturedFrame> frames) {
  for (; seen_ < frames.size(); ++seen_) {
    const auto& seen = watch_.look_at(frames[seen_], seen_);
    if (seen.subject != monitor::Observation::Subject::other &&
        starts_.on_frame(seen, watch_.follower()) == monitor::Start::restart)
      restarts_.push_back(seen_);
    watch_.settle();
    if (watch_.counted() == counted_) continue;
    counted_ = watch_.counted();
    for (std::size_t i = 0; i < violated_.size(); ++i) {
      const auto& one = *watch_.monitors()[i];
      for (std::size_t j = 0; j < violated_[i].size(); ++j) {
        const auto now = one.tallies()[j].violated;
        if (now == violated_[i][j]) continue;
        violated_[i][j] = now;
        broken_[seen_].emplace_back(one.rule().requirements[j]);
      }
    }
  }
}

void LiveMonitors::lose_track() {
  watch_.on_loss();
  starts_.on_loss();
}

std::vector<std::string> LiveMonitors::rules_below(const steps::Actual& actual) const {
  using Kind = steps::Actual::Kind;
  if (!actual.decisive || (actual.kind != Kind::violation && actual.kind != Kind::aborted)) return {};
  const auto found = broken_.find(*actual.decisive);
  if (found == broken_.end()) return {};
  auto out = found->second;
  std::erase_if(out, [&](const std::string& rule) {
    return actual.kind == Kind::aborted ? rule != undefined_code : rule == reserved_bytes;
  });
  std::ranges::stable_sort(out, {}, result::depth_of_requirement);
  return out;
}

std::vector<std::string> LiveMonitors::rules_broken(const steps::Actual& actual) const {
  using Kind = steps::Actual::Kind;
  const bool read = actual.kind == Kind::mismatched || actual.kind == Kind::aborted;
  if (!read || !actual.decisive) return rules_below(actual);
  const auto found = broken_.find(*actual.decisive);
  if (found == broken_.end()) return {};
  auto out = found->second;
  std::erase_if(out, [](const std::string& rule) { return !rule.starts_with("SDO-"); });
  std::ranges::stable_sort(out, {}, result::depth_of_requirement);
  return out;
}

}  // namespace conform::engine
