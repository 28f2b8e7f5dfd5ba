// SPDX-License-Identifier: Apache-2.0
// From sections and entries to the model.
#pragma once

#include "eds/eds.hpp"
#include "eds/ini_file.hpp"

namespace conform::eds {

/// Never fails: what has no place in the model is remarked.
[[nodiscard]] EdsFile read_ini(const IniFile& file, std::string file_name);

}  // namespace conform::eds
