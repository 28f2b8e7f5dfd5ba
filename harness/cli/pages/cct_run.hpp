// SPDX-License-Identifier: Apache-2.0
// `run --cct`: the scenarios that correspond to cases of CiA's tool, in its order, and what they say for each
// of its cases.
#pragma once

#include <string>
#include <vector>

#include "eds/eds.hpp"
#include "result/run_result.hpp"
#include "scenario/catalogue.hpp"
#include "scenario/loader.hpp"

namespace conform::cli {

/// Ids of the scenarios that correspond to a case, each once, where its first case stands in the tool.
[[nodiscard]] std::vector<std::string> cct_order(const scenario::Suite& suite,
                                                 const scenario::Catalogue& catalogue);

/// One row for each case of the tool. A case has failed when one of the cases here has; none rests on the
/// outcome of another. `description`: of the device, for the case that checks it; nullptr: none is given.
[[nodiscard]] std::vector<result::ComparedCase> cct_outcomes(const result::RunResult& run,
                                                             const scenario::Suite& suite,
                                                             const scenario::Catalogue& catalogue,
                                                             const eds::EdsFile* description);

}  // namespace conform::cli
