// SPDX-License-Identifier: Apache-2.0
// An XDD or XDC in the words of CiA 306.
#pragma once

#include <string>

#include "eds/convert/unsaid.hpp"

namespace conform::eds {

/// `target` is eds or dcf; an EDS leaves out what is configured (actual values, denotations, commissioning).
[[nodiscard]] Converted to_ini(const EdsFile& source, Format target, std::string file_name);

}  // namespace conform::eds
