// SPDX-License-Identifier: Apache-2.0
#include "cli/blame.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "result/causes.hpp"

namespace conform::cli {

Result<Blame> blame_of(const std::string& defect, const std::vector<std::string>& violates,
                       const Bench& bench) {
  Blame out;
  out.defect = defect;
  // Scenarios of long transfers take ten times as long as all others together; few defects need them.
  for (const bool slow : {false, true}) {
    engine::RunOptions options;
    options.plan.slow = slow;
    const auto run = simulate({.defects = {defect}}, bench.profile, bench.suite, bench.catalogue,
                              std::move(options), bench.seed);
    if (!run) return std::unexpected(run.error());
    for (const auto& cause : result::causes_of(run->result)) {
      out.causes.push_back(cause.primary.finding->requirement);
      out.about.push_back(fmt::format("{}, {}, {} cases, {} resting: {}", cause.about,
                                      to_string(cause.verdict), cause.cases.size(), cause.resting.size(),
                                      join(cause.requirements, " ")));
    }
    if (!out.causes.empty()) break;
  }
  out.right = !out.causes.empty() && std::ranges::find(violates, out.causes.front()) != violates.end();
  return out;
}

}  // namespace conform::cli
