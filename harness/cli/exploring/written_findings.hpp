// SPDX-License-Identifier: Apache-2.0
// The file of `explore --write`: findings as scenarios that have been played, so that it has as scenarios
// what shows again each time, and not with a right device; the rest it has as comments.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "cli/proof/selftest.hpp"
#include "device/profile.hpp"
#include "explore/explorer.hpp"
#include "scenario/catalogue.hpp"

namespace conform::cli {

struct WrittenFindings {
  std::size_t shown = 0;     ///< scenarios that show it again each time
  std::size_t silent = 0;    ///< comments: those that do not always
  std::size_t unfair = 0;    ///< comments: those that a right device fails, too
  std::size_t unjudged = 0;  ///< findings that no scenario can be made of: they are comments

  /// "2 scenarios that show it 10 of 10 times; in comments 1 that does not, 1 without a known rule, or a step
  /// that could ask for it"
  [[nodiscard]] std::string text() const;
};

/// Writes the file and plays it ten times against a simulated node with `switches`, which is like the one
/// that was explored, and against `right`, which is the same without what is wrong. `how`: the command that
/// found them. Error: it cannot be written, or nothing can be played.
[[nodiscard]] Result<WrittenFindings> write_findings(const std::string& file,
                                                     std::span<const explore::Finding> findings,
                                                     const explore::Vocabulary& words, const std::string& how,
                                                     const NodeSwitches& switches, const NodeSwitches& right,
                                                     const device::Profile& profile,
                                                     const scenario::Catalogue& catalogue);

}  // namespace conform::cli
