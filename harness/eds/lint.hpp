// SPDX-License-Identifier: Apache-2.0
// What is wrong in a device description. A finding is an opinion about the file, never about the device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "eds/eds.hpp"

namespace conform::eds {

/// error: the file contradicts the standard or itself. warning: tools will disagree about it. note: worth a
/// look.
enum class Severity : std::uint8_t { note, warning, error };
[[nodiscard]] std::string_view to_string(Severity severity);

/// A code is given once and never to another rule, also when its rule is gone.
struct Rule {
  std::string_view code;  ///< "EDS254"
  Severity severity;
  std::string_view title;   ///< one sentence about the mistake, no full stop
  std::string_view source;  ///< document and clause or subject
};

struct RuleGroup {
  std::string_view title;
  std::span<const Rule* const> rules;  ///< ascending by code
};

struct Finding {
  const Rule* rule;  ///< lives as long as the program
  Position at;       ///< always known
  std::string
      message;  ///< one sentence, lower case, no full stop; quotes raw bytes of the file: print it escaped
  std::string hint;  ///< what to do about it, or empty
  /// Another severity than that of the rule, by a policy (lint_policy.hpp).
  std::optional<Severity> decided = {};
  unsigned number = 0;   ///< from 1 on, in the order of the file; 0: not numbered
  unsigned because = 0;  ///< the number of the finding that this one is a consequence of (lint_roots.hpp)

  [[nodiscard]] Severity severity() const { return decided.value_or(rule->severity); }
};

struct LintReport {
  std::vector<Finding> findings;                   ///< by position
  std::size_t left_out = 0;                        ///< beyond `most_of_a_rule` of one rule
  std::map<const Rule*, std::size_t> left_out_of;  ///< the same for each rule
  std::size_t allowed = 0;                         ///< taken away by a policy

  [[nodiscard]] std::size_t count(Severity severity) const;
};

inline constexpr std::size_t most_of_a_rule = 1000;

[[nodiscard]] LintReport lint(const EdsFile& file);

/// The rules of lint().
[[nodiscard]] std::span<const RuleGroup> rule_groups();
/// These and the ones about comments for the lint (lint_comments.hpp).
[[nodiscard]] std::span<const RuleGroup> all_rule_groups();
/// nullptr when there is no such code.
[[nodiscard]] const Rule* find_rule(std::string_view code);
/// The page of all codes, docs/eds-lint.md.
[[nodiscard]] std::string lint_table_markdown();

}  // namespace conform::eds
