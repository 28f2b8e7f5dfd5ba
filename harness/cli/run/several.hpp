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

/// Writes what was asked for (a path for each format, by its name) of all devices, and prints the matrix
/// unless `quiet`. The exit code of the matrix, or that of a file that cannot be written.
[[nodiscard]] int report_devices(const std::vector<result::NamedRun>& devices,
                                 const std::map<std::string, std::string>& asked, bool quiet,
                                 const std::string& color);
/// The formats of which several devices can be one file; the others tell of one device each.
[[nodiscard]] bool is_of_several(std::string_view format);

}  // namespace conform::cli
