// SPDX-License-Identifier: Apache-2.0
// Many independent pieces of work on all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.hpp"

namespace conform {

/// Calls work(0) to work(count - 1), each once, on `jobs` threads (0: as many as the machine has cores).
/// Every call must have all it changes to itself. What one throws, memory that is not there above all, is
/// thrown here when all threads have ended; what has not begun by then is left out.
inline void in_parallel(std::size_t count, unsigned jobs, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::atomic_flag failed;
  std::exception_ptr failure;
  if (jobs == 0) jobs = std::max(1U, std::thread::hardware_concurrency());
  const auto take = [&] {
    try {
      for (auto i = next++; i < count && !failed.test(); i = next++) work(i);
    } catch (...) {
      if (!failed.test_and_set()) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> workers;
    // The caller is one of them, and the only one where there is little to do.
    for (std::size_t job = 1; job < std::min<std::size_t>(jobs, count); ++job) workers.emplace_back(take);
    take();
  }
  if (failure) std::rethrow_exception(failure);
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
