// SPDX-License-Identifier: Apache-2.0
// Comments of a description that speak to the lint: `; lint: allow EDS210 our tool maps it`, in XML
// `<!-- lint: allow EDS210 our tool maps it -->`.
//
// Above everything else it holds for the whole file. Before a section (in XML: an element) it holds for that
// section, before the section of an object for its sub-indices as well; before an entry for that line.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "eds/lint.hpp"

namespace conform::eds {

/// One rule that a comment allows.
struct Allowed {
  const Rule* rule;
  Position at;        ///< of the comment
  Position from, to;  ///< findings in [from, to)
  bool whole_file = false;

  [[nodiscard]] bool covers(const Finding& finding) const {
    return finding.rule == rule && (whole_file || (finding.at >= from && finding.at < to));
  }
};

struct LintComments {
  static constexpr std::size_t most = 1000;  ///< so that no file takes long; what is beyond is not looked at

  std::vector<Allowed> allowed;
  std::vector<Finding> findings;  ///< about the comments themselves

  [[nodiscard]] bool full() const { return allowed.size() >= most || findings.size() >= most; }
};

/// `bytes` is what `file` was read from.
[[nodiscard]] LintComments read_lint_comments(std::string_view bytes, const EdsFile& file);

/// The rules about such comments; what they tell needs the text, so they are not part of lint().
extern const RuleGroup comment_rules;
/// "An allow allows nothing".
[[nodiscard]] Finding nothing_allowed(const Allowed& allowed);

}  // namespace conform::eds
