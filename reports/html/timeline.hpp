// SPDX-License-Identifier: Apache-2.0
// The frames of a finding: a drawing to scale with a lane for the host and one for the device, and a table of
// the same frames with their bytes and what they mean.
#pragma once

#include <string>

#include "reports/html/book.hpp"
#include "result/run_result.hpp"

namespace conform::reports::html {

/// The frames of a finding and the time in which none came that was waited for, as markup; empty where there
/// are no frames. Times are told since the case began.
[[nodiscard]] std::string frames(const Book& book, const result::CaseResult& one,
                                 const result::Finding& finding);

}  // namespace conform::reports::html
