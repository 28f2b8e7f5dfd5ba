// SPDX-License-Identifier: Apache-2.0
// A model as the text of an XDD or XDC (CiA 311, schema 1.1).
#pragma once

#include <string>

#include "eds/eds.hpp"

namespace conform::eds {

/// A container with a profile of the device and one of the communication network. The fields must be in the
/// words of CiA 311 (to_xdd()) and be UTF-8. An object whose access is `rwr` or `rww` refers to a parameter,
/// which alone has a word for that. The same model gives the same bytes.
[[nodiscard]] std::string write_xdd(const EdsFile& file);

}  // namespace conform::eds
