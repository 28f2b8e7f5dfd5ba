// SPDX-License-Identifier: Apache-2.0
// What an error frame of SocketCAN tells (linux/can/error.h). The controller makes it; it is never on the
// wire.
#pragma once

#include "can/frame.hpp"

namespace conform::can {

/// One frame may tell several things.
struct ErrorFrame {
  bool not_acknowledged = false;  ///< nobody took a frame of ours
  bool violated = false;          ///< a frame was no frame by ISO 11898-1
  bool bus_off = false;
};

/// Of a frame that is an error frame.
[[nodiscard]] ErrorFrame read_error_frame(const Frame& frame);

}  // namespace conform::can
