// SPDX-License-Identifier: Apache-2.0
// A small process that outlives the run. If the run dies, by whatever signal, it makes the reports from the
// journal.
#pragma once

#include <sys/types.h>

#include <string>

#include "can/descriptor.hpp"
#include "cli/run/run_journal.hpp"

namespace conform::cli {

class Guardian {
 public:
  /// Starts it; nothing is guarded where that fails, and the run goes on.
  explicit Guardian(const RunJournal& journal);
  Guardian(const Guardian&) = delete;
  Guardian& operator=(const Guardian&) = delete;
  /// Tells it that the run is over, and waits until it is gone.
  ~Guardian();

 private:
  can::Descriptor life_;  ///< its end of the pipe closes with this process
  pid_t process_ = -1;
};

/// The guardian itself, in a process of its own: the hidden sub-command `guard`.
[[nodiscard]] int guard_command(const std::string& path);

/// A fault of this process, such as a crash of the simulated node, is written to the journal before it dies
/// of it.
void record_faults_in(int journal);
/// The simulated node shares the process: once it has taken this long without any progress, it hangs.
void watch_progress(int journal);
/// Nothing of the node runs any more.
void stop_watching();
void note_progress();

}  // namespace conform::cli
