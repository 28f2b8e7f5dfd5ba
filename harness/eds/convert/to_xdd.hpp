// SPDX-License-Identifier: Apache-2.0
// An EDS or DCF in the words of CiA 311.
#pragma once

#include "base/error.hpp"
#include "eds/convert/unsaid.hpp"

namespace conform::eds {

/// `target` is xdd or xdc; an XDD leaves out what is configured (actual values, denotations, commissioning).
/// What CompactSubObj and CompactPDO imply is written out. Fails as expand() does.
[[nodiscard]] Result<Converted> to_xdd(const EdsFile& source, Format target, std::string file_name);

}  // namespace conform::eds
