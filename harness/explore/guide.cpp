// SPDX-License-Identifier: Apache-2.0
#include "explore/guide.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace conform::explore {
namespace {

/// So that a long search does not keep all that it has played.
constexpr std::size_t most_kept = 20'000;

Conversation first_of(const Conversation& all, std::size_t count) {
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(count, all.size()))};
}

void append(Conversation& to, const Conversation& from, std::size_t first) {
  for (auto i = first; i < from.size(); ++i) to.push_back(from[i]);
}

}  // namespace

bool Guide::note(const Conversation& conversation, std::span<const std::uint64_t> states) {
  std::size_t end = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (seen_.insert(states[i]).second) end = i + 1;
  }
  if (end == 0 || kept_.size() == most_kept) return false;
  kept_.push_back(first_of(conversation, end));
  return true;
}

Conversation Guide::like_kept(Random& random, Conversation fresh, std::size_t length) const {
  using namespace std::chrono_literals;
  // The latest ones came furthest: half of the time one of them.
  const auto recent = std::min<std::size_t>(kept_.size(), 50);
  const auto& one =
      kept_[random.chance(50) ? kept_.size() - 1 - random.below(recent) : random.below(kept_.size())];
  Conversation out;
  switch (random.below(4)) {
    case 0:  // as it was, and on
      out = one;
      append(out, fresh, 0);
      break;
    case 1: {  // the head of one and the tail of another
      const auto& other = kept_[random.below(kept_.size())];
      out = first_of(one, 1 + random.below(one.size()));
      append(out, other, random.below(other.size()));
      append(out, fresh, 0);
      break;
    }
    case 2: {  // something left out
      const auto first = random.below(one.size());
      out = first_of(one, first);
      append(out, one, first + 1 + random.below(4));
      append(out, fresh, 0);
      break;
    }
    default: {  // something put in between
      const auto first = random.below(one.size());
      out = first_of(one, first);
      if (random.chance(30)) out.push_back(wait(Duration(1ms) * (1 + random.below(400))));
      const auto piece = 1 + random.below(12);
      append(out, first_of(fresh, piece), 0);
      append(out, one, first);
      append(out, fresh, piece);
      break;
    }
  }
  if (out.size() > length) out.resize(length);
  return out;
}

}  // namespace conform::explore
