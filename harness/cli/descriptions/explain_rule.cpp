// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/explain_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/text.hpp"
#include "eds/lint_examples.hpp"

namespace conform::cli {
namespace {

std::string_view group_of(const eds::Rule& rule) {
  for (const auto& group : eds::all_rule_groups()) {
    if (std::ranges::find(group.rules, &rule) != group.rules.end()) return group.title;
  }
  return {};
}

std::string_view meaning(eds::Severity severity) {
  switch (severity) {
    case eds::Severity::error: return "the file contradicts the standard or itself";
    case eds::Severity::warning: return "legal or not, tools will disagree about it";
    case eds::Severity::note: return "worth a look";
  }
  return {};
}

std::string indented(std::string_view example) {
  std::string out;
  const auto printed = eds::shown(example);
  std::string_view text = printed;
  if (text.ends_with('\n')) text.remove_suffix(1);
  for (const auto line : split(text, '\n')) {
    // An empty line makes sections easier to tell apart.
    if (line.starts_with('[') && !out.empty()) out += "\n";
    out += fmt::format("    {}\n", line);
  }
  return out;
}

/// Where an example stands, unless it is an EDS.
std::string_view kind_of(const eds::LintExample& example) {
  if (example.file.ends_with(".dcf")) return ", in a DCF";
  return example.file.ends_with(".xdd") ? ", in an XDD" : "";
}

}  // namespace

std::string explain_rule(const eds::Rule& rule) {
  auto out = fmt::format("{}  {}\n\n  {}\n\n", rule.code, group_of(rule), rule.title);
  out += fmt::format("  source    {}\n", rule.source);
  out += fmt::format("  severity  {}: {}\n", to_string(rule.severity), meaning(rule.severity));
  if (const auto* example = eds::find_example(rule.code)) {
    const auto kind = kind_of(*example);
    out += fmt::format("\n  Wrong{}\n{}", kind, indented(example->wrong));
    out += fmt::format("\n  Right{}\n{}", kind, indented(example->right));
  } else if (const auto reason = eds::why_no_example(rule.code); !reason.empty()) {
    out += fmt::format("  example   none: {}\n", reason);
  }
  return out +
         fmt::format(
             "\n  Allowed where it is meant\n"
             "    ; lint: allow {0} REASON     in the file: at its head, before a section or before an entry\n"
             "    --allow {0}                  on the command line; --severity {0}=note makes it a note\n"
             "    lint: allow: - rule: {0}     in .canopen-conform.yaml (docs/eds-lint-in-ci.md)\n",
             rule.code);
}

}  // namespace conform::cli
