// SPDX-License-Identifier: Apache-2.0
// `eds lint`: what is wrong in device descriptions, by the rules as a vendor decided about them.
#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "base/files.hpp"
#include "base/text.hpp"
#include "cli/commands/commands.hpp"
#include "cli/descriptions/eds_formats.hpp"
#include "cli/descriptions/line_diff.hpp"
#include "cli/descriptions/lint_baseline.hpp"
#include "cli/descriptions/lint_config.hpp"
#include "cli/descriptions/lint_files.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "eds/ini_file.hpp"
#include "eds/lint_policy.hpp"
#include "eds/read.hpp"

namespace conform::cli {
namespace {

Result<eds::LintPolicy> policy_of(const EdsLintCommand& options) {
  eds::LintPolicy out;
  for (const auto& code : options.allow) {
    const auto rule = named_rule(code);
    if (!rule) return std::unexpected(rule.error());
    out.off.insert(*rule);
  }
  for (const auto& text : options.severity) {
    const auto severity = parse_severity(text);
    if (!severity) return std::unexpected(severity.error());
    out.severity[severity->first] = severity->second;
  }
  return out;
}

/// The page of the rules that came with the program, in a checkout or installed; empty when it is not there.
std::string page_of_rules() {
  const auto suites = find_suites(std::string());
  if (!suites) return {};
  for (const auto* way : {"../docs/eds-lint.md", "../../doc/canopen-conform/docs/eds-lint.md"}) {
    std::error_code error;
    const auto page = std::filesystem::canonical(std::filesystem::path(*suites) / way, error);
    if (!error) return file_uri(page.string());
  }
  return {};
}

EdsLinted lint_bytes(const std::string& path, std::string bytes, const eds::LintPolicy& policy,
                     bool with_fixes) {
  EdsLinted out;
  out.file = path;
  const auto file = eds::read(bytes, path);
  if (!file) {
    out.unreadable = file.error();
    return out;
  }
  out.bytes = std::move(bytes);
  out.kind = std::string(to_string(file->format));
  out.xml = file->is_xml();
  out.report = eds::apply(policy, eds::lint(*file), out.bytes, *file);
  if (!with_fixes) return out;
  const eds::Fixer fixer(out.bytes, *file);
  for (const auto& finding : out.report.findings) out.fixes.push_back(fixer.fix(finding));
  return out;
}

/// Where nothing is left to mend. What one fix makes room for another may use, so it takes a few rounds.
EdsLinted fixed(EdsLinted linted, const eds::LintPolicy& policy) {
  constexpr int most_rounds = 16;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<eds::Fix> fixes;
    for (const auto& fix : linted.fixes) {
      if (fix) fixes.push_back(*fix);
    }
    if (fixes.empty()) break;
    auto bytes = eds::with_fixes(linted.bytes, fixes);
    if (bytes == linted.bytes) break;
    auto next = lint_bytes(linted.file, std::move(bytes), policy, true);
    if (next.unreadable) break;
    linted = std::move(next);
  }
  return linted;
}

class Run {
 public:
  explicit Run(const EdsLintCommand& options)
      : options_(options),
        configs_(options.config, options.no_config, use_colour(options.color, 2)),
        baseline_path_(options.baseline),
        rules_uri_(options.rules_uri) {}

  int run() {
    auto policy = policy_of(options_);
    if (!policy) return report_error(policy.error(), exit_usage);
    const auto paths = description_files(options_.files);
    if (!paths) return report_error(paths.error(), exit_usage);
    for (const auto& path : *paths) {
      if (const auto looked = look(path, *policy); !looked) return report_error(looked.error(), exit_usage);
    }
    if (const auto known = baseline(); !known) return report_error(known.error(), exit_usage);
    if (options_.fix || options_.dry_run) {
      if (options_.format == "text") print(diffs_);
    }
    print_findings();
    int code = 0;
    for (const auto& file : files_) {
      if (file.unreadable) code = report_error(*file.unreadable, exit_environment);
    }
    for (const auto& error : unwritten_) code = report_error(error, exit_environment);
    if (options_.write_baseline) return code;
    for (const auto& file : files_) {
      if (file.report.count(eds::Severity::error) > 0 ||
          (options_.strict && file.report.count(eds::Severity::warning) > 0))
        code = exit_usage;
    }
    return code;
  }

 private:
  Result<void> look(const std::string& path, const eds::LintPolicy& options) {
    const auto config = configs_.of(path);
    if (!config) return std::unexpected(config.error());
    if (*config != nullptr) {
      if (baseline_path_.empty()) baseline_path_ = (*config)->baseline;
      if (rules_uri_.empty()) rules_uri_ = (*config)->rules_uri;
    }
    auto bytes = read_file(path, eds::IniFile::most_bytes);
    if (!bytes) {
      EdsLinted none;
      none.file = path;
      none.unreadable = bytes.error();
      files_.push_back(std::move(none));
      return {};
    }
    const bool mend = options_.fix || options_.dry_run;
    const auto policy = policy_for(path, *config, options);
    auto linted = lint_bytes(path, std::move(*bytes), policy, mend || options_.format == "sarif");
    if (mend && !linted.unreadable) linted = mended(std::move(linted), policy);
    files_.push_back(std::move(linted));
    return {};
  }

  EdsLinted mended(EdsLinted before, const eds::LintPolicy& policy) {
    auto after = fixed(before, policy);
    const auto diff = line_diff(before.bytes, after.bytes, before.file, use_colour(options_.color, 1));
    diffs_ += diff;
    if (diff.empty() || options_.dry_run) return before;
    if (const auto written = write_file_atomically(after.file, std::string_view(after.bytes)); !written) {
      unwritten_.push_back(written.error());
      return before;
    }
    return after;
  }

  Result<void> baseline() {
    if (baseline_path_.empty()) {
      if (options_.write_baseline)
        return fail("no baseline is named", {}, "--baseline FILE --write-baseline");
      return {};
    }
    auto known = LintBaseline::read(baseline_path_, options_.write_baseline);
    if (!known) return std::unexpected(known.error());
    for (auto& file : files_) {
      if (!options_.write_baseline)
        known->apply(file);
      else
        known->take(file);
    }
    if (!options_.write_baseline) {
      for (const auto& file : known->missing_files())
        std::fprintf(stderr, "canopen-conform: %s: in the baseline, but there is no such file any more\n",
                     printable(file).c_str());
      return {};
    }
    known->drop_missing();
    if (auto written = known->write(); !written) return written;
    std::fprintf(stderr, "canopen-conform: %s: %zu known\n", printable(baseline_path_).c_str(),
                 known->count());
    return {};
  }

  void print_findings() const {
    if (options_.format == "json")
      print(eds_lint_json(files_));
    else if (options_.format == "github")
      print(eds_lint_github(files_));
    else if (options_.format == "sarif")
      print(eds_lint_sarif(files_, rules_uri_.empty() ? page_of_rules() : rules_uri_));
    else
      print(eds_lint_text(files_, options_.verbose, use_colour(options_.color, 1)));
  }

  const EdsLintCommand& options_;
  LintConfigs configs_;
  std::string baseline_path_;
  std::string rules_uri_;
  std::vector<EdsLinted> files_;
  std::string diffs_;
  std::vector<Error> unwritten_;
};

}  // namespace

int eds_lint_command(const EdsLintCommand& options) {
  if (options.rules) {
    print(eds::lint_table_markdown());
    return 0;
  }
  if (options.files.empty())
    return report_error({"no file is named", {}, "canopen-conform eds lint FILE..."}, exit_usage);
  return Run(options).run();
}

}  // namespace conform::cli
