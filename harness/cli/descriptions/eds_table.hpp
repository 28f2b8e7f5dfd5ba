// SPDX-License-Identifier: Apache-2.0
// A device description for reading.
#pragma once

#include <string>
#include <vector>

#include "eds/eds.hpp"

namespace conform::cli {

/// What the device is, and a line for each entry of its dictionary. `objects` is the dictionary in full
/// (eds/expand.hpp).
[[nodiscard]] std::string eds_table(const eds::EdsFile& file, const std::vector<eds::Object>& objects);
[[nodiscard]] std::string eds_json(const eds::EdsFile& file, const std::vector<eds::Object>& objects);

}  // namespace conform::cli
