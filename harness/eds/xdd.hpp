// SPDX-License-Identifier: Apache-2.0
// XDD and XDC (CiA 311): the same description as XML.
#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "eds/eds.hpp"

namespace conform::eds {

/// Reads XML into the model. Namespaces are ignored; what a CANopenObject leaves to the parameter it refers
/// to (uniqueIDRef) is taken from there. Refused is what is not well-formed, too deep, or no profile
/// container.
[[nodiscard]] Result<EdsFile> read_xdd(std::string_view bytes, std::string file_name);

}  // namespace conform::eds
