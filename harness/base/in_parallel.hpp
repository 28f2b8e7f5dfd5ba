// SPDX-License-Identifier: Apache-2.0
// Many independent pieces of work on all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

namespace conform {

/// Calls work(0) to work(count - 1), each once, on `jobs` threads (0: as many as the machine has cores).
/// Every call must have all it changes to itself.
inline void in_parallel(std::size_t count, unsigned jobs, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> workers;
  if (jobs == 0) jobs = std::max(1U, std::thread::hardware_concurrency());
  const auto take = [&] {
    for (auto i = next++; i < count; i = next++) work(i);
  };
  // The caller is one of them, and the only one where there is little to do.
  for (std::size_t job = 1; job < std::min<std::size_t>(jobs, count); ++job) workers.emplace_back(take);
  take();
}

}  // namespace conform
