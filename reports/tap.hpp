// SPDX-License-Identifier: Apache-2.0
// Test Anything Protocol, version 13, which every reader knows (14 adds nothing that is used here): a line
// per case, what is wrong below it.
#pragma once

#include <string>

#include "result/run_result.hpp"

namespace conform::reports {

/// fail, error, inconclusive and not run: `not ok`; waived: `not ok ... # todo` (directives know no case),
/// which does not fail; not applicable: `ok ... # SKIP`; a warning: `ok` with a comment. A run that stopped
/// early ends with `Bail out!`.
[[nodiscard]] std::string tap(const result::RunResult& run);

}  // namespace conform::reports
