// SPDX-License-Identifier: Apache-2.0
// Work that may crash, loop or eat all memory, each piece in a process of its own.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace conform::cli {

/// What one process may use.
struct ProcessLimits {
  unsigned seconds = 20;            ///< of processor time: what is simulated never waits
  std::size_t memory = 2UL << 30U;  ///< bytes of address space; no limit where AddressSanitizer needs it
};

/// How a piece of work ended.
struct Ending {
  enum class Kind : unsigned char { returned, crashed, hung, out_of_memory };
  Kind kind = Kind::returned;
  std::string text;  ///< what the work returned, or how it crashed: "SIGSEGV", "exception: ..."
};

/// Calls work(0) to work(count - 1), each once, in forked processes of which `jobs` (0: as many as the
/// machine has cores) run at a time. The calling process must have no other thread. `ended` is told of each.
[[nodiscard]] std::vector<Ending> in_processes(std::size_t count, unsigned jobs, const ProcessLimits& limits,
                                               const std::function<std::string(std::size_t)>& work,
                                               const std::function<void(std::size_t)>& ended = {});

}  // namespace conform::cli
