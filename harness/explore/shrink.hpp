// SPDX-License-Identifier: Apache-2.0
// Makes a conversation as short and as plain as it can be while it still shows the same.
#pragma once

#include <cstddef>
#include <functional>

#include "explore/action.hpp"

namespace conform::explore {

/// Whether a conversation, played from power-on, shows what is looked for.
using Shows = std::function<bool(const Conversation&)>;

struct Shrunk {
  Conversation conversation;
  std::size_t tries = 0;  ///< conversations played
};

/// Delta debugging over the actions, then over transfers, values and times, again until nothing more can go.
/// `conversation` must show it. At most `most_tries` conversations are played.
[[nodiscard]] Shrunk shrink(Conversation conversation, const Shows& shows, std::size_t most_tries = 2000);

}  // namespace conform::explore
