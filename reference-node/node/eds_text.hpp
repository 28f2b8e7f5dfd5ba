// SPDX-License-Identifier: Apache-2.0
// The device description (EDS, CiA 306-1) of the conformant node, made from its dictionary so that both
// agree.
#pragma once

#include <string>

namespace refnode {

/// Independent of the node-ID: defaults that hold it are written as $NODEID+0x80.
[[nodiscard]] std::string eds_text();

}  // namespace refnode
