// SPDX-License-Identifier: Apache-2.0
// Which of the cases a run plays, and how often: a part of them, those that failed, each several times.
#pragma once

#include <cstddef>
#include <string>

#include "base/error.hpp"

namespace conform::engine {
struct PlanOptions;
struct RunOptions;
}  // namespace conform::engine

namespace conform::device {
class Dictionary;
}

namespace conform::cli {

/// As on the command line.
struct Choice {
  std::string shard;         ///< "2/5"; empty: the whole
  std::string rerun_failed;  ///< result.json or journal; empty: not only what failed
  std::string budget;        ///< "60 s"; empty: as long as it takes
  std::size_t repeat = 1;
  bool until_fail = false;
  bool fail_fast = false;
};

/// Error: no shard, no run, or options that need others.
[[nodiscard]] Result<void> choose(const Choice& choice, engine::RunOptions& options);

struct LoadedSuites;

/// Error: what is asked for, or what is to be left out, is not there; a misspelt name would leave its part of
/// the run out, or in, without a word. Which instances of a scenario there are is known only when the device
/// was asked.
[[nodiscard]] Result<void> is_there(const LoadedSuites& suites, const device::Dictionary& described,
                                    engine::PlanOptions plan);

}  // namespace conform::cli
