// SPDX-License-Identifier: Apache-2.0
// The search: draws conversations, plays them against device and model, makes what differs short, and goes on
// behind it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "explore/adapt.hpp"
#include "explore/assign.hpp"
#include "explore/draw.hpp"
#include "explore/duel.hpp"

namespace conform::explore {

/// One thing that is not as it should be, as short as it shows.
struct Finding {
  Conversation conversation;
  Played played;                       ///< of it, with trace and answers
  std::optional<Assigned> assigned;    ///< nullopt: differs from the model, no rule known
  std::uint64_t episode = 0;           ///< in which it was found
  std::size_t actions_until = 0;       ///< of the whole search before it was found
  std::size_t drawn = 0;               ///< actions of the conversation before it was made short
  unsigned repeated = 0, repeats = 0;  ///< how often the short one showed it again

  [[nodiscard]] bool is_flaky() const { return repeated < repeats; }
  [[nodiscard]] bool is_violation() const { return assigned && assigned->grade == Grade::violated; }
};

struct SearchOptions {
  std::uint64_t seed = 1;
  std::size_t most_actions = 100'000;
  std::size_t most_findings = 20;
  std::size_t episode_length = 80;
  std::size_t most_tries = 600;  ///< conversations played to make one shorter
  unsigned repeats = 3;
  /// Conversations of earlier searches with such a device: they are played first.
  std::vector<Conversation> corpus{};
  /// Of a hundred conversations, those that are made from others which came to a new state; the rest is drawn
  /// anew. Of a device on an interface none: each must be drawn with its caution.
  unsigned guided = 0;
  Offer offer{};  ///< legal choices that the model does not have yet
  /// What may be done to the device; empty: everything.
  std::function<bool(const Action&)> may{};
  /// Asked between episodes; true ends the search. For budgets of time.
  std::function<bool()> is_over{};
  /// Told of each finding as it is made; true ends the search.
  std::function<bool(const Finding&)> on_finding{};
};

struct SearchResult {
  std::vector<Finding> findings;
  std::size_t actions = 0, episodes = 0;
  std::size_t shrinking = 0;          ///< conversations played to make others shorter
  std::size_t distrusted = 0;         ///< episodes in which the host lost frames or was late
  std::size_t passed_by = 0;          ///< differences of a real device that did not show again
  std::size_t known = 0;              ///< episodes that ended with what was known already
  std::size_t states = 0;             ///< abstract states that were reached
  std::vector<Conversation> kept{};   ///< conversations that reached one where none had been
  std::optional<Error> ended_by{};    ///< the bus or the device was gone: what was found until then is here
  std::vector<std::string> chosen{};  ///< legal choices of the device that its model was told of on the way
};

/// Error: device or model cannot be made.
[[nodiscard]] Result<SearchResult> search(const Bench& bench, const Vocabulary& words,
                                          const SearchOptions& options);

}  // namespace conform::explore
