// SPDX-License-Identifier: Apache-2.0
// How the SDO server misbehaves in what it makes of requests and when; what it answers is changed by
// filters.
#pragma once

#include <cstdint>
#include <functional>

#include "can/frame.hpp"

namespace refnode {

struct SdoFaults {
  using Misread = std::function<void(conform::can::Frame&, std::uint8_t node_id)>;
  /// Changes a data frame that came, whatever its CAN-ID; empty in a conformant node.
  Misread misread;

  bool partial_download_visible = false;  ///< segments are written into the entry as they come
  bool refuses_in_stopped = false;        ///< requests in Stopped are aborted
  bool serves_after_stopped = false;      ///< the last request of Stopped is served afterwards
  bool blocked_after_stopped = false;     ///< a transfer that met Stopped lets no new one begin
};

}  // namespace refnode
