// SPDX-License-Identifier: Apache-2.0
// What both Markdown reports show.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "result/causes.hpp"
#include "result/run_result.hpp"

namespace conform::reports {

/// Title with the verdict, tool, counts of cases, why it stopped: at most 5 lines.
[[nodiscard]] std::string markdown_head(const result::RunResult& run);
/// "1 fail, 2106 pass" with the worst first, or "none".
[[nodiscard]] std::string counts_text(const result::Counts& counts);
/// The list a reader begins with: one line for each cause, the first `most` of them; the rest is counted.
/// Empty, or at most `most` + 4 lines.
[[nodiscard]] std::string markdown_causes(const result::RunResult& run,
                                          const std::vector<result::Cause>& causes, std::size_t most);
/// `heading` as it is and the first `most` items as a list; the rest is counted. Empty without items.
[[nodiscard]] std::string markdown_list(std::string_view heading, const std::vector<std::string>& items,
                                        std::size_t most);
/// A heading and the first `most` waivers, with the rest counted. Empty, or at most `most` + 4 lines.
[[nodiscard]] std::string markdown_waivers(const result::RunResult& run, std::size_t most);

}  // namespace conform::reports
