// SPDX-License-Identifier: Apache-2.0
// Putting back what a case changed: in reverse, by the procedure each kind of entry needs, and checked by
// reading.
#pragma once

#include <string>
#include <vector>

#include "engine/run_session.hpp"

namespace conform::engine {

struct RestoreReport {
  std::size_t written = 0;        ///< entries that had to be written back
  std::vector<std::string> left;  ///< "1014h:00 is 0000 06A0h, was 0000 0085h"
};

/// Error: the environment failed. A device that refuses is in the report.
[[nodiscard]] Result<RestoreReport> restore(RunSession& session, std::vector<Change> changes);

}  // namespace conform::engine
