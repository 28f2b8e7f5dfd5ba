// SPDX-License-Identifier: Apache-2.0
// The frames of a finding: a drawing to scale with a lane for the host and one for the device, and a table of
// the same frames with their bytes and what they mean.
#pragma once

#include <span>
#include <string>

#include "reports/html/book.hpp"
#include "result/run_result.hpp"

namespace conform::reports::html {

/// Markup; empty where there are no frames. Times are told since the case began.
[[nodiscard]] std::string frames(const Book& book, const result::CaseResult& one,
                                 std::span<const result::EvidenceFrame> evidence);

}  // namespace conform::reports::html
