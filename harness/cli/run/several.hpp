// SPDX-License-Identifier: Apache-2.0
// Several results at once: the parts of a run, and runs of several devices.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "result/merge.hpp"

namespace conform::cli {

/// Parts of one run (run --shard) become that run; what is left are the devices, each under a name of its
/// own. Error: parts that do not belong together.
[[nodiscard]] Result<std::vector<result::NamedRun>> devices_of(std::vector<result::NamedRun> runs);

/// Where the HTML report of a run may be: where its journal says (`own`; empty: it does not), or beside its
/// result under the name of that (`pump1.json`, `pump1.html`), or under that of the templates for pipelines
/// (`report.html`). As absolute paths.
[[nodiscard]] std::vector<std::string> pages_beside(const std::string& result, const std::string& own);
/// The first of the files that is the HTML report of this run, and not of one before or after it; empty:
/// none.
[[nodiscard]] std::string page_of(const result::RunResult& run, const std::vector<std::string>& files);

/// Writes what was asked for (a path for each format, by its name) of all devices, and prints the matrix
/// unless `quiet`. The exit code of the matrix, or that of a file that cannot be written.
[[nodiscard]] int report_devices(const std::vector<result::NamedRun>& devices,
                                 const std::map<std::string, std::string>& asked, bool quiet,
                                 const std::string& color);
/// The formats of which several devices can be one file; the others tell of one device each.
[[nodiscard]] bool is_of_several(std::string_view format);

}  // namespace conform::cli
