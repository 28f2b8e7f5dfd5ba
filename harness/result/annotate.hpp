// SPDX-License-Identifier: Apache-2.0
// What a finished run says about the frames of its capture.
#pragma once

#include "can/capture.hpp"
#include "result/run_result.hpp"

namespace conform::result {

/// Comments the first and the last frame of each finished case with its name, and frames that decided a
/// finding with its words. A comment that is there already is not added again.
void annotate(can::Capture& capture, const RunResult& run);

}  // namespace conform::result
