// SPDX-License-Identifier: Apache-2.0
// What single SDO frames say of the transfer that they belong to.
#pragma once

#include <string>

#include "can/frame.hpp"

namespace conform::cli {

/// Command 80h, by client or server (7.2.4.3.17).
[[nodiscard]] bool is_abort(const can::Frame& frame);
/// Whether a request that is no segment of a block begins or ends a transfer, whatever was before.
[[nodiscard]] bool begins_anew(const can::Frame& frame);
/// Why segments of the old block download must not follow this answer; empty: they may, or the server has
/// ended it. `segments`: some follow.
[[nodiscard]] std::string why_out_of_step(const can::Frame& then, const can::Frame& now, bool segments);

}  // namespace conform::cli
