// SPDX-License-Identifier: Apache-2.0
// SARIF 2.1.0: rules with their help, findings with fingerprints that survive other lines, and fixes.
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/text.hpp"
#include "cli/descriptions/eds_formats.hpp"
#include "cli/descriptions/fingerprint.hpp"
#include "cli/descriptions/source_lines.hpp"
#include "eds/lint_examples.hpp"
#include "eds/lint_roots.hpp"
#include "eds/text_lines.hpp"

namespace conform::cli {
namespace {

using Json = nlohmann::ordered_json;

Json rule_json(const eds::Rule& rule, std::string_view group, const std::string& rules_uri) {
  const auto* example = eds::find_example(rule.code);
  const std::string title(rule.title);
  auto help = fmt::format("{}. Source: {}.", title, rule.source);
  auto markdown = fmt::format("{}.\n\nSource: {}\n", title, rule.source);
  if (example != nullptr) {
    const auto wrong = eds::shown(example->wrong), right = eds::shown(example->right);
    const auto* language = example->file.ends_with(".xdd") ? "xml" : "ini";
    help += fmt::format("\n\nWrong:\n{}\nRight:\n{}", wrong, right);
    markdown += fmt::format("\nWrong:\n```{0}\n{1}```\nRight:\n```{0}\n{2}```\n", language, wrong, right);
  }
  Json out = {{"id", std::string(rule.code)},
              {"shortDescription", {{"text", title}}},
              {"help", {{"text", help}, {"markdown", markdown}}},
              {"defaultConfiguration", {{"level", std::string(to_string(rule.severity))}}},
              {"properties", {{"source", std::string(rule.source)}, {"group", std::string(group)}}}};
  if (!rules_uri.empty()) out["helpUri"] = rules_uri + "#" + lower(rule.code);
  return out;
}

Json fix_json(const EdsLinted& file, const eds::Fix& fix, const eds::TextLines& lines) {
  Json replacements = Json::array();
  SourceLines columns(file.bytes);
  for (const auto& edit : fix.edits) {
    const auto begin = lines.position(edit.offset);
    const auto end = lines.position(edit.offset + edit.length);
    Json region;
    region["startLine"] = begin.line;
    region["startColumn"] = columns.column(begin);
    region["endLine"] = end.line;
    region["endColumn"] = columns.column(end);
    replacements.push_back(
        {{"deletedRegion", std::move(region)}, {"insertedContent", {{"text", printable(edit.text, true)}}}});
  }
  Json change;
  change["artifactLocation"]["uri"] = file_uri(file.file);
  change["replacements"] = std::move(replacements);
  return {{"description", {{"text", printable(fix.what)}}}, {"artifactChanges", Json::array({change})}};
}

Json location_of(const EdsLinted& file, const eds::Finding& finding, SourceLines& columns) {
  Json place;
  place["physicalLocation"]["artifactLocation"]["uri"] = file_uri(file.file);
  place["physicalLocation"]["region"] = {{"startLine", finding.at.line},
                                         {"startColumn", columns.column(finding.at)}};
  return place;
}

void add_results(const EdsLinted& file, const std::map<std::string_view, std::size_t>& places,
                 Json& results) {
  SourceLines columns(file.bytes);
  const eds::TextLines lines(file.bytes);
  const eds::Roots roots(file.report);
  const auto prints = fingerprints(file.report, FindingPlaces(file.bytes, file.xml));
  for (std::size_t i = 0; i < file.report.findings.size(); ++i) {
    const auto& finding = file.report.findings[i];
    Json result = {{"ruleId", std::string(finding.rule->code)},
                   {"ruleIndex", places.at(finding.rule->code)},
                   {"level", std::string(to_string(finding.severity()))},
                   {"message", {{"text", with_hint(finding)}}},
                   {"locations", Json::array({location_of(file, finding, columns)})},
                   {"partialFingerprints", {{"canopenConformFinding/v1", prints[i]}}}};
    if (const auto* root = roots.of(finding)) {
      auto place = location_of(file, *root, columns);
      place["message"]["text"] = fmt::format("because of {}: {}", root->rule->code, with_hint(*root));
      result["relatedLocations"] = Json::array({std::move(place)});
    }
    if (i < file.fixes.size() && file.fixes[i])
      result["fixes"] = Json::array({fix_json(file, *file.fixes[i], lines)});
    results.push_back(std::move(result));
  }
}

}  // namespace

std::string file_uri(std::string_view path) {
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

std::string eds_lint_sarif(const std::vector<EdsLinted>& files, const std::string& rules_uri) {
  Json rules = Json::array();
  std::map<std::string_view, std::size_t> places;
  for (const auto& group : eds::all_rule_groups()) {
    for (const auto* rule : group.rules) {
      places.emplace(rule->code, rules.size());
      rules.push_back(rule_json(*rule, group.title, rules_uri));
    }
  }
  Json results = Json::array();
  Json notifications = Json::array();
  for (const auto& file : files) {
    if (file.unreadable)
      notifications.push_back(
          {{"level", "error"}, {"message", {{"text", printable(file.unreadable->text())}}}});
    add_results(file, places, results);
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
