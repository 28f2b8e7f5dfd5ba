// SPDX-License-Identifier: Apache-2.0
// What a report is told beside the run itself.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "result/causes.hpp"
#include "result/run_result.hpp"

namespace conform::reports {

/// The files of one run, so that a report can name the others. Paths are absolute.
struct Beside {
  std::string path{};  ///< of the report that is written; empty: it has none yet
  std::map<std::string, std::string>
      reports{};           ///< by name of the format, "capture" and "candump" among them
  std::string captures{};  ///< folder with one capture for each cause; empty: none

  /// `file` as the report finds it from its own folder on, so that the link holds where both are moved
  /// together; the path itself where nothing leads there.
  [[nodiscard]] std::string relative(const std::string& file) const;
  /// The same of the capture of a cause; `number`: in causes_of(), from 1. Empty: there is none.
  [[nodiscard]] std::string capture_of(const result::RunResult& run, const result::Cause& cause,
                                       std::size_t number) const;
};

}  // namespace conform::reports
