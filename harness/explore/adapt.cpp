// SPDX-License-Identifier: Apache-2.0
#include "explore/adapt.hpp"

#include <algorithm>
#include <utility>

namespace conform::explore {
namespace {

constexpr std::size_t most_agreed = 16;
/// Of the choices that may be the first of two.
constexpr std::size_t most_first = 4;

}  // namespace

void Adapter::agreed(const Conversation& conversation, const Played& played) {
  Heard heard{conversation, played.recording};
  if (agreed_.size() < most_agreed) {
    agreed_.push_back(std::move(heard));
  } else {
    agreed_[seen_ % most_agreed] = std::move(heard);
  }
  ++seen_;
}

Result<Played> Adapter::play_again(const Bench& bench, const Heard& heard) {
  return heard.recording == nullptr ? play(bench, heard.conversation)
                                    : play(bench, heard.conversation, *heard.recording);
}

std::optional<Choices> Adapter::learn(const Conversation& conversation, const Played& told) {
  const Heard heard{conversation, told.recording};
  const auto signature = told.difference->signature(conversation);
  // What changes something, though it does not explain all: a device has often chosen twice. Nor does what
  // explains this one, but not what came before: that a wrong choice is taken back is half of the way.
  std::vector<std::size_t> matters;
  for (std::size_t choice = 0; choice < offer_.choices.size(); ++choice) {
    if (refuted_.contains(choice)) continue;
    const auto candidate = with(chosen_, choice);
    const auto played = play_again(bench_with(candidate), heard);
    if (!played) continue;  // it excludes another
    if (!played->difference && take(candidate, heard)) return Choices{choice};
    const bool changes = !played->difference || played->difference->signature(conversation) != signature;
    if (changes && matters.size() < most_first) matters.push_back(choice);
  }
  for (const auto first : matters) {
    for (std::size_t second = 0; second < offer_.choices.size(); ++second) {
      if (second == first || refuted_.contains(second)) continue;
      const auto candidate = with(with(chosen_, first), second);
      const auto played = play_again(bench_with(candidate), heard);
      if (played && !played->difference && take(candidate, heard)) return Choices{first, second};
    }
  }
  if (refute(heard)) return Choices{};
  return std::nullopt;
}

/// A choice that this conversation contradicts, and that nothing but what it once explained speaks for, was
/// none: what it explained will be met again, and is to be explained in another way or is a finding.
bool Adapter::refute(const Heard& heard) {
  for (const auto choice : Choices(chosen_)) {
    auto candidate = chosen_;
    candidate.erase(choice);
    auto bench = bench_with(candidate);
    const auto agrees = [&](const Heard& each) {
      const auto played = play_again(bench, each);
      return played && !played->difference;
    };
    const auto stands = [&](const Heard& each) { return !each.always || agrees(each); };
    if (!agrees(heard) || !std::ranges::all_of(explained_, stands) || !std::ranges::all_of(agreed_, agrees))
      continue;
    std::erase_if(explained_, [&](const Heard& each) { return !each.always && !agrees(each); });
    chosen_ = std::move(candidate);
    bench_.model = std::move(bench.model);
    refuted_.insert(choice);
    return true;
  }
  return false;
}

bool Adapter::explains_without(const Conversation& conversation, const Played& told) const {
  const Heard heard{conversation, told.recording};
  return std::ranges::any_of(chosen_, [&](std::size_t choice) {
    auto candidate = chosen_;
    candidate.erase(choice);
    const auto played = play_again(bench_with(candidate), heard);
    return played && !played->difference;
  });
}

/// Where it agrees with all that was played before.
bool Adapter::take(const Choices& candidate, const Heard& heard) {
  auto bench = bench_with(candidate);
  if (!holds_for_all(bench)) return false;
  chosen_ = candidate;
  bench_.model = std::move(bench.model);
  explained_.push_back(heard);
  return true;
}

/// One that is chosen already is taken back: it may have explained something else by chance.
Choices Adapter::with(const Choices& chosen, std::size_t choice) const {
  auto out = chosen;
  if (out.erase(choice) > 0) return out;
  const auto& group = offer_.choices[choice].group;
  if (!group.empty())
    std::erase_if(out, [&](std::size_t other) { return offer_.choices[other].group == group; });
  out.insert(choice);
  return out;
}

Bench Adapter::bench_with(const Choices& chosen) const {
  auto out = bench_;
  out.model = offer_.model_of(chosen);
  out.model_may_be_slower = false;
  return out;
}

bool Adapter::holds_for_all(const Bench& bench) const {
  const auto agrees = [&](const Heard& each) {
    const auto played = play_again(bench, each);
    return played && !played->difference;
  };
  return std::ranges::all_of(explained_, agrees) && std::ranges::all_of(agreed_, agrees);
}

}  // namespace conform::explore
