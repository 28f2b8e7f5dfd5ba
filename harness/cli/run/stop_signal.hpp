// SPDX-License-Identifier: Apache-2.0
// How a command that has nothing to put back is stopped by SIGINT and SIGTERM. `run` has its own way.
#pragma once

#include <atomic>
#include <csignal>

#include "cli/run/terminal.hpp"

namespace conform::cli {

inline std::atomic<int> stop_signal{0};  ///< the signal that came last; 0: none

/// From now on the signals are noted in `stop_signal`, and do not end the process.
inline void note_stop_signals() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int came) { stop_signal = came; });
}

/// Tells why the command ends. Exit code: 128 + signal where one has ended it, otherwise `code`.
inline int report_end(const Error& error, int code) {
  const int signal = stop_signal;
  return report_error(error, signal != 0 ? 128 + signal : code);
}

}  // namespace conform::cli
