// SPDX-License-Identifier: Apache-2.0
// Findings that are there because of another one: who mends the root, mends them as well.
#pragma once

#include <map>

#include "eds/lint.hpp"

namespace conform::eds {

/// Numbers the findings from 1 on in their order, and says of each of which other it is a consequence.
void mark_roots(const EdsFile& file, LintReport& report);

/// Looks roots up; the report must outlive it and stay as it is.
class Roots {
 public:
  explicit Roots(const LintReport& report);

  /// The finding that lies under `finding`, itself a consequence of none; nullptr when there is none, or when
  /// it is not in the report any more (a policy, a baseline).
  [[nodiscard]] const Finding* of(const Finding& finding) const;

 private:
  std::map<unsigned, const Finding*> findings_;
};

}  // namespace conform::eds
