// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/eds_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/text.hpp"
#include "cli/descriptions/source_lines.hpp"
#include "eds/lint_roots.hpp"
#include "reports/annotations.hpp"

namespace conform::cli {
namespace {

// Keys stay in the order in which they are written here.
using Json = nlohmann::ordered_json;

std::string counted(std::size_t count, std::string_view word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

/// Escapes of workflow commands; in a property a colon and a comma would end it.
std::string github_escaped(std::string_view text, bool property) {
  return reports::github_text(printable(text), property);
}

using Alike = std::vector<const eds::Finding*>;

/// The message without what differs between findings of one root: sections, quoted text, numbers.
std::string shape(std::string_view message) {
  constexpr std::string_view digits = "0123456789";
  constexpr std::string_view number = "0123456789abcdefABCDEFxh";
  std::string out;
  while (!message.empty()) {
    const char c = message.front();
    std::size_t length = 1;
    if (c == '[')
      length = std::min(message.find(']'), message.size() - 1) + 1;
    else if (c == '\'')
      length = std::min(message.find('\'', 1), message.size() - 1) + 1;
    else if (digits.find(c) != std::string_view::npos)
      length = std::min(message.find_first_not_of(number), message.size());
    out += length == 1 && c != '[' && digits.find(c) == std::string_view::npos ? c : '#';
    message.remove_prefix(length);
  }
  return out;
}

std::vector<Alike> ungrouped(const eds::LintReport& report, const eds::Roots& roots) {
  std::vector<Alike> out;
  for (const auto& finding : report.findings) {
    if (roots.of(finding) == nullptr) out.push_back({&finding});
  }
  return out;
}

using Consequences = std::map<const eds::Finding*, Alike>;  ///< by root

Consequences consequences_of(const eds::LintReport& report, const eds::Roots& roots) {
  Consequences out;
  for (const auto& finding : report.findings) {
    if (const auto* root = roots.of(finding)) out[root].push_back(&finding);
  }
  return out;
}

/// What follows from the findings of a group: each on a line, or more than a few of a rule in one.
std::string consequence_lines(const Alike& group, const Consequences& consequences, bool all) {
  constexpr std::size_t few = 3;
  std::map<std::string_view, Alike> by_code;
  for (const auto* root : group) {
    const auto found = consequences.find(root);
    if (found == consequences.end()) continue;
    for (const auto* finding : found->second) by_code[finding->rule->code].push_back(finding);
  }
  std::string out;
  for (const auto& [code, findings] : by_code) {
    const auto shown = all || findings.size() <= few ? findings.size() : 1;
    for (std::size_t i = 0; i < shown; ++i) {
      const auto& finding = *findings[i];
      out += fmt::format("      = and so {}[{}] in line {}: {}\n", to_string(finding.severity()), code,
                         finding.at.line, with_hint(finding));
    }
    if (shown < findings.size())
      out += fmt::format("      = and so {} more {} (all with -v)\n", findings.size() - shown, code);
  }
  return out;
}

/// A few are told one by one. Consequences are told with their roots.
std::vector<Alike> grouped(const eds::LintReport& report, const eds::Roots& roots) {
  constexpr std::size_t few = 3;
  std::map<std::pair<const eds::Rule*, std::string>, Alike> groups;
  for (const auto& finding : report.findings) {
    if (roots.of(finding) == nullptr) groups[{finding.rule, shape(finding.message)}].push_back(&finding);
  }
  std::vector<Alike> out;
  for (auto& [root, alike] : groups) {
    if (alike.size() > few)
      out.push_back(std::move(alike));
    else
      for (const auto* finding : alike) out.push_back({finding});
  }
  std::ranges::sort(out, [](const Alike& a, const Alike& b) {
    return std::tie(a.front()->at, a.front()->rule->code, a.front()->message) <
           std::tie(b.front()->at, b.front()->rule->code, b.front()->message);
  });
  return out;
}

std::string alike_line(const Alike& group) {
  constexpr std::size_t most = 8;
  std::string lines;
  for (std::size_t i = 1; i < std::min(group.size(), most + 1); ++i)
    lines += fmt::format("{}{}", i == 1 ? "" : ", ", group[i]->at.line);
  return fmt::format("      = and {} alike, in lines {}{} (all with -v)\n", group.size() - 1, lines,
                     group.size() > most + 1 ? ", ..." : "");
}

}  // namespace

std::string eds_lint_totals(const std::vector<EdsLinted>& files) {
  std::size_t errors = 0;
  std::size_t warnings = 0;
  std::size_t notes = 0;
  std::size_t allowed = 0;
  std::size_t known = 0;
  std::size_t unreadable = 0;
  for (const auto& file : files) {
    errors += file.report.count(eds::Severity::error);
    warnings += file.report.count(eds::Severity::warning);
    notes += file.report.count(eds::Severity::note);
    allowed += file.report.allowed;
    known += file.known;
    unreadable += file.unreadable ? 1U : 0U;
  }
  auto out = fmt::format("{}, {}, {}, {}", counted(files.size(), "file"), counted(errors, "error"),
                         counted(warnings, "warning"), counted(notes, "note"));
  if (allowed > 0) out += fmt::format(", {} allowed", allowed);
  if (known > 0) out += fmt::format(", {} known", known);
  if (unreadable > 0) out += fmt::format(", {} cannot be read", counted(unreadable, "file"));
  return out + "\n";
}

std::string eds_lint_text(const std::vector<EdsLinted>& files, bool all, bool colour) {
  const std::string_view off = colour ? "\x1b[0m" : "";
  const std::string_view bold = colour ? "\x1b[1m" : "";
  std::string out;
  for (const auto& file : files) {
    // Of a right file nobody asks for lines.
    const SourceLines lines(file.report.findings.empty() ? std::string_view() : file.bytes);
    const eds::Roots roots(file.report);
    const auto consequences = consequences_of(file.report, roots);
    for (const auto& group : all ? ungrouped(file.report, roots) : grouped(file.report, roots)) {
      const auto& finding = *group.front();
      const auto severity = finding.severity();
      const std::string_view tint = !colour                              ? ""
                                    : severity == eds::Severity::error   ? "\x1b[1;31m"
                                    : severity == eds::Severity::warning ? "\x1b[1;33m"
                                                                         : "\x1b[1;36m";
      out += fmt::format("{}{}:{}:{} {}{}[{}]:{} {}\n", bold, printable(file.file), to_string(finding.at),
                         off, tint, to_string(severity), finding.rule->code, off, with_hint(finding));
      out += lines.excerpt_at(finding.at, tint, off);
      if (group.size() > 1) out += alike_line(group);
      out += consequence_lines(group, consequences, all);
    }
    for (const auto& gone : file.gone)
      out += fmt::format("{}: known, but gone: {}\n", printable(file.file), printable(gone));
    if (file.report.left_out > 0)
      out += fmt::format("{}: {} more not shown\n", printable(file.file), file.report.left_out);
  }
  return out + eds_lint_totals(files);
}

std::string eds_lint_json(const std::vector<EdsLinted>& files) {
  Json out;
  out["schema"] = "canopen-conform/eds-lint/1";
  out["files"] = Json::array();
  for (const auto& file : files) {
    Json one;
    one["file"] = printable(file.file);
    if (file.unreadable) {
      one["error"] = printable(file.unreadable->text());
    } else {
      one["kind"] = file.kind;
      one["errors"] = file.report.count(eds::Severity::error);
      one["warnings"] = file.report.count(eds::Severity::warning);
      one["notes"] = file.report.count(eds::Severity::note);
      one["left_out"] = file.report.left_out;
      one["allowed"] = file.report.allowed;
      one["known"] = file.known;
      one["gone"] = Json::array();
      for (const auto& gone : file.gone) one["gone"].push_back(printable(gone));
      one["findings"] = Json::array();
      const eds::Roots roots(file.report);
      for (const auto& finding : file.report.findings) {
        one["findings"].push_back({{"code", std::string(finding.rule->code)},
                                   {"severity", std::string(to_string(finding.severity()))},
                                   {"line", finding.at.line},
                                   {"column", finding.at.column},
                                   {"message", printable(finding.message)},
                                   {"hint", printable(finding.hint)},
                                   {"rule", std::string(finding.rule->title)},
                                   {"source", std::string(finding.rule->source)}});
        if (const auto* root = roots.of(finding))
          one["findings"].back()["because"] = {
              {"code", std::string(root->rule->code)}, {"line", root->at.line}, {"column", root->at.column}};
      }
    }
    out["files"].push_back(std::move(one));
  }
  return out.dump(2) + "\n";
}

std::string eds_lint_github(const std::vector<EdsLinted>& files) {
  std::string out;
  for (const auto& file : files) {
    if (file.unreadable)
      out += fmt::format("::error file={}::{}\n", github_escaped(file.file, true),
                         github_escaped(file.unreadable->text(), false));
    const eds::Roots roots(file.report);
    for (const auto& finding : file.report.findings) {
      const auto severity = finding.severity();
      const auto* root = roots.of(finding);
      const auto because =
          root == nullptr ? "" : fmt::format(" (because of {} in line {})", root->rule->code, root->at.line);
      out += fmt::format("::{} file={},line={},col={},title={}::{}\n",
                         severity == eds::Severity::note ? "notice" : to_string(severity),
                         github_escaped(file.file, true), finding.at.line, finding.at.column,
                         finding.rule->code, github_escaped(with_hint(finding) + because, false));
    }
  }
  return out;
}

}  // namespace conform::cli
