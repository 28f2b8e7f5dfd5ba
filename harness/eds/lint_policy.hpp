// SPDX-License-Identifier: Apache-2.0
// What somebody decided about the findings: rules that are off, other severities, and what comments in the
// file allow.
#pragma once

#include <map>
#include <set>
#include <string_view>

#include "eds/lint.hpp"

namespace conform::eds {

struct LintPolicy {
  std::set<const Rule*> off;
  std::map<const Rule*, Severity> severity;
};

/// The report without what is allowed, and with the severities of the policy. Comments that are wrong or
/// allow nothing become findings. `bytes` is what `file` was read from.
[[nodiscard]] LintReport apply(const LintPolicy& policy, LintReport report, std::string_view bytes,
                               const EdsFile& file);

}  // namespace conform::eds
