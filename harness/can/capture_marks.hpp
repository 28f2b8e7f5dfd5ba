// SPDX-License-Identifier: Apache-2.0
// What no frame tells, as the comment of the frame behind it, so that a capture can be judged like the run.
#pragma once

#include <string_view>

namespace conform::can {

/// The harness switched the power of the device off and on; the start that follows was not its own.
inline constexpr std::string_view power_was_switched =
    "the power of the device was switched before this frame";

}  // namespace conform::can
