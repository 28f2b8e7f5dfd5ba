// SPDX-License-Identifier: Apache-2.0
// Which LSS slaves without node-ID are on a bus, found by fastscan (CiA 305), and giving them node-IDs.
#pragma once

#include <cstddef>
#include <vector>

#include "base/error.hpp"
#include "base/strong.hpp"
#include "base/time.hpp"
#include "canopen/lss.hpp"
#include "engine/recorder.hpp"

namespace conform::engine {

struct LssSurveyOptions {
  Duration timeout = std::chrono::milliseconds(100);  ///< how long an answer may take
  std::size_t most = 127;                             ///< no more slaves are looked for
};

/// Fastscan after fastscan, until nobody answers to its start. A slave that is found waits in the
/// configuration state, where it takes no part in the next scan; at the end all are sent to waiting. Error:
/// the bus, or slaves that answer and cannot be told apart.
[[nodiscard]] Result<std::vector<canopen::LssAddress>> find_unconfigured(Recorder& recorder,
                                                                         const LssSurveyOptions& options);

/// Selects the slave and configures its node-ID, which it starts with at once. Error: the bus, no answer, or
/// a refusal.
[[nodiscard]] Result<void> give_node_id(Recorder& recorder, const canopen::LssAddress& address, NodeId node,
                                        Duration timeout);

}  // namespace conform::engine
