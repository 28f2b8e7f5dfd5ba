// SPDX-License-Identifier: Apache-2.0
// Guidance: conversations that came to a state where none had been are kept, and others are made from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include "explore/action.hpp"
#include "explore/draw.hpp"

namespace conform::explore {

class Guide {
 public:
  /// Keeps the conversation up to where it came to its last new state, if there is one.
  bool note(const Conversation& conversation, std::span<const std::uint64_t> states);

  [[nodiscard]] bool empty() const { return kept_.empty(); }
  [[nodiscard]] const std::vector<Conversation>& kept() const { return kept_; }
  [[nodiscard]] std::size_t states() const { return seen_.size(); }

  /// A kept conversation that goes on as `fresh` does, or is mixed with another one. There must be one.
  [[nodiscard]] Conversation like_kept(Random& random, Conversation fresh, std::size_t length) const;

 private:
  std::unordered_set<std::uint64_t> seen_;
  std::vector<Conversation> kept_;
};

}  // namespace conform::explore
