// SPDX-License-Identifier: Apache-2.0
// Many independent pieces of work on all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.hpp"

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

/// The same for work that gives a Result: all values in their order, or the first error among them.
template <typename Work>
auto all_in_parallel(std::size_t count, unsigned jobs, const Work& work) {
  using Answer = std::invoke_result_t<Work, std::size_t>;
  std::vector<std::optional<Answer>> answers(count);
  in_parallel(count, jobs, [&](std::size_t i) { answers[i].emplace(work(i)); });
  Result<std::vector<typename Answer::value_type>> out;
  for (auto& answer : answers) {
    if (!*answer) return out = std::unexpected(answer->error());
    out->push_back(std::move(**answer));
  }
  return out;
}

}  // namespace conform
