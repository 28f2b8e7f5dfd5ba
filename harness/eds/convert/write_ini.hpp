// SPDX-License-Identifier: Apache-2.0
// A model as the text of an EDS or DCF (CiA 306).
#pragma once

#include <string>

#include "eds/eds.hpp"

namespace conform::eds {

/// Sections in the order of CiA 306, lines ended by CR LF, every object and sub-object in a section of its
/// own, the lists made from the indices. The fields must be in the words of CiA 306 (to_ini()) and hold no
/// line ends. The same model gives the same bytes.
[[nodiscard]] std::string write_ini(const EdsFile& file);

}  // namespace conform::eds
