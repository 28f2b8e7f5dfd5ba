// SPDX-License-Identifier: Apache-2.0
// What is decided about findings in device descriptions: by options of the command line, and in
// .canopen-conform.yaml, which is looked for beside the description and in the folders above it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "eds/lint_policy.hpp"

namespace conform::cli {

inline constexpr std::string_view lint_config_name = ".canopen-conform.yaml";

/// `lint:` of the file.
struct LintConfig {
  struct Allow {
    const eds::Rule* rule;
    std::vector<std::string> files;  ///< patterns with * and ?, relative to the configuration; empty: all
  };
  std::string path;
  std::vector<Allow> allow;
  std::map<const eds::Rule*, eds::Severity> severity;
  std::string baseline;   ///< path as it can be opened, or empty
  std::string rules_uri;  ///< where docs/eds-lint.md is published, or empty
};

/// All mistakes of the file are in the text of the error, each with its line and column.
[[nodiscard]] Result<LintConfig> load_lint_config(const std::string& path, bool colour);

/// The rule, or an error with the one that was meant.
[[nodiscard]] Result<const eds::Rule*> named_rule(std::string_view code);
/// "EDS210=note"
[[nodiscard]] Result<std::pair<const eds::Rule*, eds::Severity>> parse_severity(std::string_view text);

/// Whether `text` is made like `pattern`: * stands for any text, ? for one character.
[[nodiscard]] bool matches(std::string_view pattern, std::string_view text);

/// Finds and keeps the configurations of files, each read once.
class LintConfigs {
 public:
  /// `only`: this file instead of looking for one; `none`: no file at all.
  LintConfigs(std::string only, bool none, bool colour)
      : only_(std::move(only)), none_(none), colour_(colour) {}

  /// nullptr when there is none.
  [[nodiscard]] Result<const LintConfig*> of(const std::string& file);

 private:
  [[nodiscard]] Result<const LintConfig*> load(const std::string& path);

  std::string only_;
  bool none_;
  bool colour_;
  std::map<std::string, std::string> by_folder_;  ///< folder -> configuration, or empty
  std::map<std::string, LintConfig> loaded_;
};

/// The configuration for one file, and the options, which count more.
[[nodiscard]] eds::LintPolicy policy_for(const std::string& file, const LintConfig* config,
                                         const eds::LintPolicy& options);

}  // namespace conform::cli
