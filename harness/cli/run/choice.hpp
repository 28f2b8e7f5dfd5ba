// SPDX-License-Identifier: Apache-2.0
// Which of the cases a run plays, and how often: a part of them, those that failed, each several times.
#pragma once

#include <cstddef>
#include <string>

#include "base/error.hpp"

namespace conform::engine {
struct RunOptions;
}

namespace conform::cli {

/// As on the command line.
struct Choice {
  std::string shard;         ///< "2/5"; empty: the whole
  std::string rerun_failed;  ///< result.json or journal; empty: not only what failed
  std::size_t repeat = 1;
  bool until_fail = false;
  bool fail_fast = false;
};

/// Error: no shard, no run, or options that need others.
[[nodiscard]] Result<void> choose(const Choice& choice, engine::RunOptions& options);

}  // namespace conform::cli
