// SPDX-License-Identifier: Apache-2.0
// What both directions of block transfer share.
#pragma once

#include <cstdint>

namespace refnode {

/// Segments per sub-block (CiA 301, 7.2.4.3.9): their numbers have seven bits and begin with 1.
[[nodiscard]] constexpr bool valid_block_size(std::uint8_t size) { return size >= 1 && size <= 127; }

}  // namespace refnode
