// SPDX-License-Identifier: Apache-2.0
// A device description as one page for a browser.
#pragma once

#include <string>
#include <vector>

#include "eds/eds.hpp"
#include "eds/lint.hpp"

namespace conform::cli {

/// Who the device is, what its PDOs hold, the dictionary in full (`objects`, see eds::expand()) with the
/// findings of the lint beside the entries. Needs nothing but itself, fetches nothing, and is well-formed
/// XML.
[[nodiscard]] std::string eds_page(const eds::EdsFile& file, const std::vector<eds::Object>& objects,
                                   const eds::LintReport& report);

}  // namespace conform::cli
