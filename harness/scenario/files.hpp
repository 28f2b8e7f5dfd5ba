// SPDX-License-Identifier: Apache-2.0
// Which files belong to a suite.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"

namespace conform::scenario {

/// Paths of all *.yaml files below `root/folder` relative to `root`, sorted. Symbolic links to folders are
/// not followed.
[[nodiscard]] Result<std::vector<std::string>> yaml_files_below(const std::string& root,
                                                                const std::string& folder);

/// Scenario files of a suites folder: everything below it except requirements/, devices/ and schema/.
[[nodiscard]] Result<std::vector<std::string>> scenario_files(const std::string& root);

}  // namespace conform::scenario
