// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/time.hpp"

namespace conform::result {

/// The time in which a step listened: what it waited for did not come between the decisive frame, or else the
/// beginning, and the end.
struct Listening {
  BusTime from, until;
};

}  // namespace conform::result
