// SPDX-License-Identifier: Apache-2.0
// The device that a command is to speak to: on an interface, or simulated.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "cli/run/known_device.hpp"

namespace conform::cli {

struct Simulated {
  bool simulate = false;
  std::vector<std::string> variants;  ///< legal ones, of the reference node
  std::string suites;                 ///< root folder of the program's suites
};

/// What is known of it. A simulated device of which neither profile nor description is given is the reference
/// node with its own profile, changed as its variants change it. `fallback`: the node-ID where nothing says
/// so; absent: that is an error on an interface, and 5 in the simulation.
[[nodiscard]] Result<KnownDevice> device_under_test(DeviceWords words, const Simulated& simulated,
                                                    std::optional<NodeId> fallback = std::nullopt);

}  // namespace conform::cli
