// SPDX-License-Identifier: Apache-2.0
// A small picture for a page of a project.
#pragma once

#include <string>

#include "result/run_result.hpp"

namespace conform::reports {

/// SVG: "CiA 301 | 661/665", passed (warnings included) of judged requirements; "+2 waived" behind them. The
/// words say it, the colour repeats it.
[[nodiscard]] std::string badge(const result::RunResult& run);

}  // namespace conform::reports
