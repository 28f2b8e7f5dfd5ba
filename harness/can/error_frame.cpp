// SPDX-License-Identifier: Apache-2.0
#include "can/error_frame.hpp"

#include <linux/can/error.h>

namespace conform::can {

ErrorFrame read_error_frame(const Frame& frame) {
  return {.not_acknowledged = (frame.id & CAN_ERR_ACK) != 0,
          .violated = (frame.id & (CAN_ERR_PROT | CAN_ERR_BUSERROR)) != 0,
          .bus_off = (frame.id & CAN_ERR_BUSOFF) != 0};
}

}  // namespace conform::can
