// SPDX-License-Identifier: Apache-2.0
// Where the suites are, and the catalogue and scenarios in them.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "scenario/catalogue.hpp"
#include "scenario/loader.hpp"

namespace conform::cli {

/// `given`, else $CANOPEN_CONFORM_SUITES, else share/canopen-conform/suites beside the program, else a folder
/// `suites` above it.
[[nodiscard]] Result<std::string> find_suites(const std::string& given);

struct LoadedSuites {
  std::string root;
  scenario::Catalogue catalogue;
  scenario::Suite suite;
};

/// Catalogue and all scenarios; mistakes in them are an Error that holds their diagnostics.
[[nodiscard]] Result<LoadedSuites> load_suites(const std::string& root, bool colour);

/// FNV-1a over the scenario and requirement files: tells in a report which suite judged.
[[nodiscard]] std::string suite_digest(const std::string& root);

}  // namespace conform::cli
