// SPDX-License-Identifier: Apache-2.0
// Where the suites are, and the catalogue and scenarios in them.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "result/patterns.hpp"
#include "result/worth.hpp"
#include "scenario/catalogue.hpp"
#include "scenario/loader.hpp"

namespace conform::cli {

/// The suites of the program, and folders of the user's own that add to them.
struct SuiteFolders {
  std::string root;
  std::vector<std::string> own{};
};

/// What messages and reports call the program's suites, wherever they are. Own ones are called as the user
/// did.
constexpr const char* shown_root = "suites";

/// The program's suites: $CANOPEN_CONFORM_SUITES, else share/canopen-conform/suites beside the program, else
/// a folder `suites` above it. Folders that are given add to them; a whole set, such as a checkout's, takes
/// their place. A folder `suites` beside the device profile adds to them without being asked for.
[[nodiscard]] Result<SuiteFolders> find_suites(const std::vector<std::string>& given,
                                               const std::string& profile = {});

/// The same without own folders: a whole set, or that of the program where none is given.
[[nodiscard]] Result<std::string> find_suites(const std::string& given);

struct LoadedSuites {
  scenario::Catalogue catalogue;
  scenario::Suite suite;
};

/// Catalogue and all scenarios; mistakes in them are an Error that holds their diagnostics.
[[nodiscard]] Result<LoadedSuites> load_suites(const SuiteFolders& folders, bool colour);
[[nodiscard]] inline Result<LoadedSuites> load_suites(const std::string& root, bool colour) {
  return load_suites(SuiteFolders{root}, colour);
}

/// How known mistakes show, by the file that belongs to the program's suites at `root`; none where it is
/// missing. Error: it is no such file.
[[nodiscard]] Result<std::vector<result::Pattern>> load_patterns(const std::string& root);

/// What cases are worth and how long they take, by the file that belongs to the program's suites at `root`;
/// of nothing is anything known where it is missing. Error: it is no such file.
[[nodiscard]] Result<result::Worths> load_worths(const std::string& root);

/// Adds to a run that was killed which known mistakes it looks like, if the suites are still at `root`.
void name_known_mistakes(result::RunResult& run, const std::string& root);

/// Tells in a report which suites judged, whatever folder they were in: "suite.digest" (FNV-1a over the
/// scenario and requirement files), and "suite.own" with folder and digest of each that is the user's own.
[[nodiscard]] std::vector<result::Property> suite_properties(const SuiteFolders& folders);

}  // namespace conform::cli
