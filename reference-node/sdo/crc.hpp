// SPDX-License-Identifier: Apache-2.0
// The CRC of block transfer (CiA 301, 7.2.4.3.16): polynomial x^16 + x^12 + x^5 + 1 (1021h), start value 0,
// most significant bit first, no final inversion. "123456789" gives 31C3h.
#pragma once

#include <cstdint>

#include "base/bytes.hpp"

namespace refnode {

/// The CRC of `bytes` behind data whose CRC is `before`.
[[nodiscard]] std::uint16_t sdo_crc(conform::ByteView bytes, std::uint16_t before = 0);

}  // namespace refnode
