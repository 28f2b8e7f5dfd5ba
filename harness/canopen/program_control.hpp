// SPDX-License-Identifier: Apache-2.0
// Objects of program download and control (CiA 302-3).
#pragma once

#include "base/strong.hpp"

namespace conform::canopen {

/// 1F50h to 1F5Fh: a write is a command, which may start, stop or replace the program of the device.
[[nodiscard]] constexpr bool is_program_control(Index index) {
  return index.value() >= 0x1F50 && index.value() <= 0x1F5F;
}

}  // namespace conform::canopen
