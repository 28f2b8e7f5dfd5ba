// SPDX-License-Identifier: Apache-2.0
// From YAML to scenarios, with every mistake of a file at its place.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "scenario/catalogue.hpp"
#include "scenario/scenario.hpp"
#include "yaml/loader.hpp"

namespace conform::scenario {

/// Reads one document. `path` (relative, with extension) gives the ids. Usable when the diagnostics have no
/// errors.
[[nodiscard]] ScenarioFile load_scenarios(const yaml::Node& root, yaml::Diagnostics& diagnostics,
                                          const std::string& path, const Catalogue& catalogue);

struct Suite {
  std::vector<ScenarioFile> files;
  std::vector<std::string> problems;  ///< rendered diagnostics, one text per file with any
  std::size_t errors = 0;             ///< number of errors in them
};

struct Folder {
  std::string path;
  std::string shown;  ///< what messages and reports call it
};

/// Adds files (paths relative to the folder). Error: a file cannot be read at all.
[[nodiscard]] Result<void> add_to_suite(Suite& suite, const Folder& folder,
                                        const std::vector<std::string>& files, const Catalogue& catalogue,
                                        bool colour = false);

/// Two files of one name would give their scenarios one id.
void refuse_same_name(const ScenarioFile& file, yaml::Diagnostics& diagnostics, const std::string& other);

/// Reads files (paths relative to `root`). Error: a file cannot be read at all.
[[nodiscard]] Result<Suite> load_suite(const std::string& root, const std::vector<std::string>& files,
                                       const Catalogue& catalogue, bool colour = false);

}  // namespace conform::scenario
