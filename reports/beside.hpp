// SPDX-License-Identifier: Apache-2.0
// What a report is told beside the run itself.
#pragma once

#include <map>
#include <string>

namespace conform::reports {

/// The files of one run, so that a report can name the others. Paths are absolute.
struct Beside {
  std::string path;                            ///< of the report that is written; empty: it has none yet
  std::map<std::string, std::string> reports;  ///< by name of the format, "capture" and "candump" among them
};

}  // namespace conform::reports
