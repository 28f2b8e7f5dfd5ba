// SPDX-License-Identifier: Apache-2.0
#include "cli/usage/known_values.hpp"

#include <array>

#include <fmt/format.h>

#include "base/files.hpp"
#include "base/text.hpp"
#include "can/socketcan_interface.hpp"
#include "cli/suite_folder.hpp"
#include "defects/defect.hpp"
#include "eds/lint.hpp"
#include "monitor/watch.hpp"
#include "scenario/files.hpp"
#include "steps/step.hpp"
#include "steps/tier.hpp"
#include "usage/model.hpp"
#include "variants/variant.hpp"
#include "yaml/loader.hpp"

namespace conform::cli {
namespace {

using usage::Candidate;
using Candidates = std::vector<Candidate>;

/// What stands behind "key:", without quotes; empty: another line, or a text of several lines.
std::string_view value_of(std::string_view line, std::string_view key) {
  if (!line.starts_with(key)) return {};
  auto value = trim(line.substr(key.size()));
  const bool quoted = value.size() > 1 && (value.front() == '"' || value.front() == '\'');
  if (quoted && value.back() == value.front()) value = value.substr(1, value.size() - 2);
  return value.starts_with('>') || value.starts_with('|') ? std::string_view() : value;
}

/// The folders that the command line up to here names.
std::vector<SuiteFolders> folders_of(const usage::Place& place) {
  const auto given = [&place](const char* option) {
    const auto found = place.given.find(option);
    return found == place.given.end() ? std::vector<std::string>() : found->second;
  };
  const auto device = given("--device");
  auto found = find_suites(given("--suites"), device.empty() ? "" : device.back());
  if (!found) return {};
  return {std::move(*found)};
}

void add_ids(const std::string& root, const std::vector<std::string>& files, bool scenarios,
             Candidates& into) {
  for (const auto& file : files) {
    const auto text = read_file(root + "/" + file, yaml::max_file_size);
    if (!text) continue;
    // The id of a scenario is that of its file and its own.
    const auto prefix = scenarios ? file.substr(0, file.size() - std::string_view(".yaml").size()) + "/" : "";
    const auto found = ids_in(*text, prefix);
    into.insert(into.end(), found.begin(), found.end());
  }
}

void add_suites(const usage::Place& place, bool scenarios, Candidates& into) {
  for (const auto& folders : folders_of(place)) {
    auto all = folders.own;
    all.insert(all.begin(), folders.root);
    for (const auto& root : all) {
      const auto files =
          scenarios ? scenario::scenario_files(root) : scenario::yaml_files_below(root, "requirements");
      if (files) add_ids(root, *files, scenarios, into);
    }
  }
}

void add_monitors(Candidates& into) {
  for (const auto& rule : monitor::rules()) into.push_back({monitor::case_id(rule), std::string(rule.title)});
}

void add_defects(Candidates& into) {
  for (const auto& defect : refnode::defects())
    into.push_back({std::string(defect.id), std::string(defect.summary)});
}

void add_variants(Candidates& into) {
  for (const auto& variant : refnode::variants())
    into.push_back({std::string(variant.id), std::string(variant.summary)});
}

void add_lint_rules(Candidates& into) {
  for (const auto& group : eds::all_rule_groups()) {
    for (const auto* rule : group.rules) into.push_back({std::string(rule->code), std::string(rule->title)});
  }
}

Candidates rules_with_severities() {
  Candidates rules, out;
  add_lint_rules(rules);
  for (const auto& rule : rules) {
    for (const auto severity : {eds::Severity::error, eds::Severity::warning, eds::Severity::note})
      out.push_back({fmt::format("{}={}", rule.word, eds::to_string(severity)), rule.about});
  }
  return out;
}

Candidates topics(const usage::Place& place) {
  Candidates out;
  for (const auto* word : {"verbs", "conditions", "tiers", "channels", "profile", "coverage"})
    out.push_back({word, ""});
  for (const auto& verb : steps::verbs()) out.push_back({std::string(verb.name), std::string(verb.summary)});
  add_suites(place, false, out);
  add_suites(place, true, out);
  add_monitors(out);
  add_defects(out);
  add_variants(out);
  add_lint_rules(out);
  return out;
}

Candidates tiers() {
  Candidates out;
  for (const auto& row : steps::tier_table())
    out.push_back({std::string(steps::word_of(row.tier)), std::string(row.sends)});
  return out;
}

Candidates interfaces() {
  Candidates out;
  for (const auto& name : can::can_interfaces()) out.push_back({name, ""});
  return out;
}

/// Scenarios and monitors are chosen by the same options; a trace is judged by monitors alone.
Candidates cases(const usage::Place& place) {
  Candidates out;
  if (usage::path_of(*place.command) != "judge") add_suites(place, true, out);
  add_monitors(out);
  return out;
}

}  // namespace

Candidates ids_in(std::string_view text, const std::string& prefix) {
  Candidates out;
  std::size_t margin = std::string_view::npos;
  for (auto line : split(text, '\n')) {
    const auto begin = line.find_first_not_of(' ');
    if (begin == std::string_view::npos) continue;
    line.remove_prefix(begin);
    if (const auto id = value_of(line, "- id:"); !id.empty()) {
      // The first list tells how far the file indents them; an id further inside is something else.
      if (margin == std::string_view::npos) margin = begin;
      if (begin == margin) out.push_back({prefix + std::string(id), ""});
    } else if (!out.empty() && out.back().about.empty() && begin == margin + 2) {
      const auto title = value_of(line, "title:");
      out.back().about = title.empty() ? value_of(line, "statement:") : title;
    }
  }
  return out;
}

std::optional<Candidates> known_values(const usage::Place& place) {
  const auto name = usage::name_of(*place.option);
  const auto type = usage::type_of(*place.option);
  Candidates out;
  if (type == "RISK") return tiers();
  if (type == "TOPIC") return topics(place);
  if (type == "RULE=SEVERITY") return rules_with_severities();
  if (type == "RULE") add_lint_rules(out);
  if (name == "--interface") out = interfaces();
  if (name == "--defect") add_defects(out);
  if (name == "--variant") add_variants(out);
  if (name == "--requirement") add_suites(place, false, out);
  if (!out.empty()) return out;
  if (name == "select" || name == "--exclude" || name == "--case") return cases(place);
  return std::nullopt;
}

}  // namespace conform::cli
