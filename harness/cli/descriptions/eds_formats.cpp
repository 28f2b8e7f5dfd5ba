// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/eds_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/excerpt.hpp"
#include "base/text.hpp"
#include "reports/annotations.hpp"

namespace conform::cli {
namespace {

// Keys stay in the order in which they are written here.
using Json = nlohmann::ordered_json;

std::string counted(std::size_t count, std::string_view word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

std::string totals(const std::vector<EdsLinted>& files) {
  std::size_t errors = 0;
  std::size_t warnings = 0;
  std::size_t notes = 0;
  for (const auto& file : files) {
    errors += file.report.count(eds::Severity::error) + (file.unreadable ? 1U : 0U);
    warnings += file.report.count(eds::Severity::warning);
    notes += file.report.count(eds::Severity::note);
  }
  return fmt::format("{}, {}, {}, {}\n", counted(files.size(), "file"), counted(errors, "error"),
                     counted(warnings, "warning"), counted(notes, "note"));
}

/// Escapes of workflow commands; in a property a colon and a comma would end it.
std::string github_escaped(std::string_view text, bool property) {
  return reports::github_text(printable(text), property);
}

/// A relative reference or a file URI (RFC 3986); every byte that is not unreserved or a slash is escaped.
std::string uri(std::string_view path) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string out = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    if (plain.find(c) != std::string_view::npos)
      out += c;
    else
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

/// The lines of a description, ended as its reader takes them: LF, CR LF or CR.
class Lines {
 public:
  explicit Lines(std::string_view text) {
    while (!text.empty()) {
      const auto end = std::min(text.find_first_of("\r\n"), text.size());
      lines_.push_back(text.substr(0, end));
      text.remove_prefix(std::min(end + (text.substr(end).starts_with("\r\n") ? 2U : 1U), text.size()));
    }
  }

  /// In code points, as editors and SARIF count; positions count bytes. Ascending positions are counted once.
  [[nodiscard]] int column(eds::Position at) {
    if (at.line == 0 || at.line > lines_.size()) return static_cast<int>(at.column);
    if (at.line != counted_.line || at.column < counted_.column) {
      counted_ = {at.line, 1};
      counted_column_ = 1;
    }
    const auto line = lines_[at.line - 1];
    const auto begin = std::min<std::size_t>(counted_.column - 1, line.size());
    counted_column_ += code_points(line.substr(begin, at.column - counted_.column));
    counted_ = at;
    return counted_column_;
  }

  /// Two lines to print: the line of the place, and a caret below it.
  [[nodiscard]] std::string excerpt_at(eds::Position at, std::string_view tint, std::string_view off) const {
    // What is missing from the file as a whole stands at its begin.
    const bool whole_file = at == eds::Position{1, 1};
    if (whole_file || !at.known() || at.line > lines_.size()) return {};
    return to_lines(excerpt(lines_[at.line - 1], at.column - 1, 1), static_cast<int>(at.line), tint, off);
  }

 private:
  std::vector<std::string_view> lines_;
  eds::Position counted_;  ///< up to where `counted_column_` has counted
  int counted_column_ = 1;
};

std::string with_hint(const eds::Finding& finding) {
  return printable(finding.message) + (finding.hint.empty() ? "" : "; " + printable(finding.hint));
}

}  // namespace

std::string eds_lint_text(const std::vector<EdsLinted>& files, bool colour) {
  const std::string_view off = colour ? "\x1b[0m" : "";
  const std::string_view bold = colour ? "\x1b[1m" : "";
  std::string out;
  for (const auto& file : files) {
    const Lines lines(file.bytes);
    for (const auto& finding : file.report.findings) {
      const auto severity = finding.rule->severity;
      const std::string_view tint = !colour                              ? ""
                                    : severity == eds::Severity::error   ? "\x1b[1;31m"
                                    : severity == eds::Severity::warning ? "\x1b[1;33m"
                                                                         : "\x1b[1;36m";
      out += fmt::format("{}{}:{}:{} {}{}[{}]:{} {}\n", bold, printable(file.file), to_string(finding.at),
                         off, tint, to_string(severity), finding.rule->code, off, with_hint(finding));
      out += lines.excerpt_at(finding.at, tint, off);
    }
    if (file.report.left_out > 0)
      out += fmt::format("{}: {} more not shown\n", printable(file.file), file.report.left_out);
  }
  return out + totals(files);
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
      one["findings"] = Json::array();
      for (const auto& finding : file.report.findings) {
        one["findings"].push_back({{"code", std::string(finding.rule->code)},
                                   {"severity", std::string(to_string(finding.rule->severity))},
                                   {"line", finding.at.line},
                                   {"column", finding.at.column},
                                   {"message", printable(finding.message)},
                                   {"hint", printable(finding.hint)},
                                   {"rule", std::string(finding.rule->title)},
                                   {"source", std::string(finding.rule->source)}});
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
    for (const auto& finding : file.report.findings) {
      const auto severity = finding.rule->severity;
      out += fmt::format("::{} file={},line={},col={},title={}::{}\n",
                         severity == eds::Severity::note ? "notice" : to_string(severity),
                         github_escaped(file.file, true), finding.at.line, finding.at.column,
                         finding.rule->code, github_escaped(with_hint(finding), false));
    }
  }
  return out;
}

std::string eds_lint_sarif(const std::vector<EdsLinted>& files) {
  Json rules = Json::array();
  std::map<std::string_view, std::size_t> places;
  for (const auto& group : eds::rule_groups()) {
    for (const auto* rule : group.rules) {
      places.emplace(rule->code, rules.size());
      rules.push_back(
          {{"id", std::string(rule->code)},
           {"shortDescription", {{"text", std::string(rule->title)}}},
           {"defaultConfiguration", {{"level", std::string(to_string(rule->severity))}}},
           {"properties", {{"source", std::string(rule->source)}, {"group", std::string(group.title)}}}});
    }
  }
  Json results = Json::array();
  Json notifications = Json::array();
  for (const auto& file : files) {
    if (file.unreadable)
      notifications.push_back(
          {{"level", "error"}, {"message", {{"text", printable(file.unreadable->text())}}}});
    Lines lines(file.bytes);
    for (const auto& finding : file.report.findings) {
      Json place;
      place["physicalLocation"]["artifactLocation"]["uri"] = uri(file.file);
      place["physicalLocation"]["region"] = {{"startLine", finding.at.line},
                                             {"startColumn", lines.column(finding.at)}};
      results.push_back({{"ruleId", std::string(finding.rule->code)},
                         {"ruleIndex", places.at(finding.rule->code)},
                         {"level", std::string(to_string(finding.rule->severity))},
                         {"message", {{"text", with_hint(finding)}}},
                         {"locations", Json::array({std::move(place)})}});
    }
  }
  Json run;
  run["tool"]["driver"] = {
      {"name", "canopen-conform"}, {"version", CONFORM_VERSION}, {"rules", std::move(rules)}};
  run["invocations"] = Json::array(
      {{{"executionSuccessful", notifications.empty()}, {"toolExecutionNotifications", notifications}}});
  run["columnKind"] = "unicodeCodePoints";
  run["results"] = std::move(results);
  Json out;
  out["$schema"] = "https://json.schemastore.org/sarif-2.1.0.json";
  out["version"] = "2.1.0";
  out["runs"] = Json::array({std::move(run)});
  return out.dump(2) + "\n";
}

}  // namespace conform::cli
