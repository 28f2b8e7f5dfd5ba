// SPDX-License-Identifier: Apache-2.0
// Exploration of a device on an interface, from the lock of the interface to the last value put back.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "cli/commands/explore_command.hpp"
#include "cli/proof/explored.hpp"
#include "cli/run/known_device.hpp"
#include "explore/explorer.hpp"
#include "steps/tier.hpp"

namespace conform::cli {

struct LiveResult {
  explore::SearchResult search;
  std::vector<std::string> left;  ///< values that could not be put back, a sentence each
  std::optional<Error> lost;      ///< nobody could look what is left
};

/// Done with what is explored before the search begins, for findings to be told.
using OnDevice = std::function<void(const Explorable& device, NodeId node, steps::Tier allowed)>;

/// `root`: folder of the program's suites. Error: the search did not begin.
[[nodiscard]] Result<LiveResult> explore_live(const ExploreCommand& options, const std::string& root,
                                              KnownDevice known, explore::SearchOptions search,
                                              const OnDevice& on_device);

}  // namespace conform::cli
