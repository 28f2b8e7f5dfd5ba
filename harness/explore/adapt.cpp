// SPDX-License-Identifier: Apache-2.0
#include "explore/adapt.hpp"

#include <algorithm>
#include <utility>

namespace conform::explore {
namespace {

constexpr std::size_t most_agreed = 16;

}  // namespace

void Adapter::agreed(const Conversation& conversation) {
  if (agreed_.size() < most_agreed) {
    agreed_.push_back(conversation);
  } else {
    agreed_[seen_ % most_agreed] = conversation;
  }
  ++seen_;
}

std::optional<std::size_t> Adapter::learn(const Conversation& conversation) {
  for (std::size_t choice = 0; choice < bench_.choices.size(); ++choice) {
    const auto candidate = with(choice);
    auto bench = bench_;
    bench.model = bench_.model_of(candidate);
    const auto holds = [&](const Conversation& each) { return agrees(bench, each); };
    if (!holds(conversation) || !std::ranges::all_of(explained_, holds) ||
        !std::ranges::all_of(agreed_, holds))
      continue;
    chosen_ = candidate;
    bench_.model = std::move(bench.model);
    explained_.push_back(conversation);
    return choice;
  }
  return std::nullopt;
}

/// One that is chosen already is taken back: it may have explained something else by chance.
Choices Adapter::with(std::size_t choice) const {
  auto out = chosen_;
  if (out.erase(choice) > 0) return out;
  const auto& group = bench_.choices[choice].group;
  if (!group.empty())
    std::erase_if(out, [&](std::size_t other) { return bench_.choices[other].group == group; });
  out.insert(choice);
  return out;
}

bool Adapter::agrees(const Bench& bench, const Conversation& conversation) const {
  const auto played = play(bench, conversation);
  return played && !played->difference;
}

}  // namespace conform::explore
