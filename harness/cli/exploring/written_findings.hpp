// SPDX-License-Identifier: Apache-2.0
// The file of `explore --write`: findings as scenarios that have been played once, so that it says itself
// which of them show what was found.
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
  std::size_t shown = 0;     ///< scenarios that show it again
  std::size_t silent = 0;    ///< those that do not; the file says so
  std::size_t unjudged = 0;  ///< findings that no scenario can be made of: they are comments

  /// "3 scenarios, of which 2 show it again; 1 without a known rule is in comments"
  [[nodiscard]] std::string text() const;
};

/// Writes the file and plays it once against a simulated node with `switches`, which is like the one that was
/// explored. `how`: the command that found them. Error: it cannot be written, or nothing can be played.
[[nodiscard]] Result<WrittenFindings> write_findings(const std::string& file,
                                                     std::span<const explore::Finding> findings,
                                                     const explore::Vocabulary& words, const std::string& how,
                                                     const NodeSwitches& switches,
                                                     const device::Profile& profile,
                                                     const scenario::Catalogue& catalogue);

}  // namespace conform::cli
