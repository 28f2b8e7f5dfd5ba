// SPDX-License-Identifier: Apache-2.0
// Which entries of the communication profile are shorter than the four data bytes of an expedited transfer
// (CiA 301, 7.5): where no size is indicated, what lies behind their value has no meaning.
#pragma once

#include <cstddef>

#include "base/strong.hpp"

namespace conform::canopen {

/// 1 or 2 bytes; 4: as far as the standard tells nothing is left over.
[[nodiscard]] constexpr std::size_t length_of_short_entry(Multiplexer object) {
  const auto index = object.index.value();
  const auto sub = object.sub.value();
  switch (index) {
    case 0x1001:  // error register
    case 0x100D:  // life time factor
    case 0x1019:  // SYNC counter overflow
    case 0x1024:  // operating system command mode
    case 0x1026:  // operating system prompt
    case 0x1029:  // error behaviour
      return 1;
    case 0x100C:  // guard time
    case 0x1015:  // inhibit time of EMCY
    case 0x1017:  // heartbeat time
    case 0x1022:  // format of the stored description
      return 2;
    default: break;
  }
  const auto is_in = [index](unsigned first, unsigned last) { return index >= first && index <= last; };
  if (is_in(0x1400, 0x15FF) || is_in(0x1800, 0x19FF)) {  // transmission type, times, SYNC start value
    if (sub == 3 || sub == 5) return 2;
    return sub == 1 ? 4 : 1;
  }
  if (is_in(0x1200, 0x12FF) && sub == 3) return 1;                 // node-ID of the other side
  if ((index == 0x1023 || index == 0x1025) && sub == 2) return 1;  // status
  const bool has_subs = is_in(0x1200, 0x12FF) || is_in(0x1600, 0x17FF) || is_in(0x1A00, 0x1BFF) ||
                        index == 0x1003 || is_in(0x1010, 0x1011) || index == 0x1016 || index == 0x1018 ||
                        index == 0x1020 || index == 0x1023 || index == 0x1025 || index == 0x1028;
  return has_subs && sub == 0 ? 1 : 4;
}

}  // namespace conform::canopen
