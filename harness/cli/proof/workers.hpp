// SPDX-License-Identifier: Apache-2.0
// Many independent runs on all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

namespace conform::cli {

/// Calls work(0) to work(count - 1), each once, on `jobs` threads (0: as many as the machine has cores).
/// Every call must have all it changes to itself.
inline void in_parallel(std::size_t count, unsigned jobs, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> workers;
  if (jobs == 0) jobs = std::max(1U, std::thread::hardware_concurrency());
  for (unsigned job = 0; job < jobs; ++job) {
    workers.emplace_back([&] {
      for (auto i = next++; i < count; i = next++) work(i);
    });
  }
}

}  // namespace conform::cli
