// SPDX-License-Identifier: Apache-2.0
// Which device descriptions are meant by the files and folders of a command line.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"

namespace conform::cli {

/// Files as they are named; of a folder every *.eds, *.dcf, *.xdd and *.xdc in it and below, sorted, in
/// whatever case, but nothing hidden. Each file once. A folder without any, or one that cannot be read, is an
/// error; files that do not exist are left for the reader to tell.
[[nodiscard]] Result<std::vector<std::string>> description_files(const std::vector<std::string>& named);

}  // namespace conform::cli
