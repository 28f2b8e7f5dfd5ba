// SPDX-License-Identifier: Apache-2.0
#include "cli/descriptions/lint_config.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "base/text.hpp"
#include "yaml/fields.hpp"
#include "yaml/loader.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;

fs::path absolute_path(const fs::path& path) {
  std::error_code error;
  auto out = fs::absolute(path, error);
  return error ? path : out.lexically_normal();
}

const eds::Rule* rule_at(const yaml::Node& node, yaml::Diagnostics& diagnostics) {
  const auto rule = named_rule(node.text());
  if (rule) return *rule;
  diagnostics.error(node, rule.error().what, rule.error().hint);
  return nullptr;
}

void read_allow(const yaml::Field& list, LintConfig& out) {
  for (const auto& item : list.items()) {
    auto fields = item.fields("allowed rule");
    const auto code = fields.required("rule");
    const auto* rule = code.text() ? rule_at(*code.node(), fields.diagnostics()) : nullptr;
    // Nothing is done with it: it is there for those who read the file.
    (void)fields.required("reason").text();
    auto files = fields.optional("files").list_or_one([](const yaml::Field& each) { return each.text(); });
    fields.finish();
    if (rule != nullptr) out.allow.push_back({rule, std::move(files).value_or(std::vector<std::string>())});
  }
}

void read_severities(const yaml::Field& field, LintConfig& out) {
  auto fields = field.fields("mapping of rules to severities");
  fields.allow_others();
  if (!fields.present()) return;
  for (const auto& entry : fields.node()->entries()) {
    const auto* rule = rule_at(entry.key, fields.diagnostics());
    const auto severity = fields.optional(entry.key.text())
                              .one_of<eds::Severity>({{"error", eds::Severity::error},
                                                      {"warning", eds::Severity::warning},
                                                      {"note", eds::Severity::note}});
    if (rule != nullptr && severity) out.severity[rule] = *severity;
  }
}

}  // namespace

Result<const eds::Rule*> named_rule(std::string_view code) {
  if (const auto* rule = eds::find_rule(code)) return rule;
  std::vector<std::string_view> codes;
  for (const auto& group : eds::all_rule_groups()) {
    for (const auto* rule : group.rules) codes.push_back(rule->code);
  }
  const auto near = did_you_mean(code, codes);
  return fail(fmt::format("there is no rule '{}'", code), {},
              near.empty() ? "'canopen-conform eds lint --rules' prints all"
                           : fmt::format("did you mean '{}'?", near));
}

Result<std::pair<const eds::Rule*, eds::Severity>> parse_severity(std::string_view text) {
  const auto equals = text.find('=');
  if (equals == std::string_view::npos)
    return fail(fmt::format("'{}' names no severity", text), {}, "write EDS210=note");
  const auto rule = named_rule(text.substr(0, equals));
  if (!rule) return std::unexpected(rule.error());
  for (const auto severity : {eds::Severity::error, eds::Severity::warning, eds::Severity::note}) {
    if (text.substr(equals + 1) == to_string(severity)) return std::pair(*rule, severity);
  }
  return fail(fmt::format("'{}' is no severity", text.substr(equals + 1)), {},
              "error, warning or note; --allow switches a rule off");
}

bool matches(std::string_view pattern, std::string_view text) {
  // The last star and what it has taken so far: enough to go back to.
  auto star = std::string_view::npos;
  std::size_t taken = 0;
  std::size_t p = 0;
  std::size_t t = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      taken = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++taken;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

Result<LintConfig> load_lint_config(const std::string& path, bool colour) {
  auto document = yaml::load_file(path);
  if (!document) return std::unexpected(document.error());
  LintConfig out;
  out.path = path;
  auto& diagnostics = document->diagnostics;
  if (document->root) {
    yaml::Fields fields(*document->root, diagnostics, "configuration");
    if (fields.present()) static_cast<void>(fields.required("format").number(1, 1));
    auto lint = fields.optional("lint").fields("configuration of the lint");
    read_allow(lint.optional("allow"), out);
    read_severities(lint.optional("severity"), out);
    if (const auto baseline = lint.optional("baseline").text())
      out.baseline = (fs::path(path).parent_path() / *baseline).string();
    out.rules_uri = lint.optional("rules_uri").text().value_or("");
    lint.finish();
    fields.finish();
  }
  if (diagnostics.has_errors()) {
    auto text = diagnostics.render(colour);
    if (text.ends_with('\n')) text.pop_back();
    return fail("the configuration has mistakes:\n" + text, path);
  }
  return out;
}

Result<const LintConfig*> LintConfigs::load(const std::string& path) {
  if (const auto known = loaded_.find(path); known != loaded_.end()) return &known->second;
  auto config = load_lint_config(path, colour_);
  if (!config) return std::unexpected(config.error());
  return &loaded_.emplace(path, std::move(*config)).first->second;
}

Result<const LintConfig*> LintConfigs::of(const std::string& file) {
  if (none_) return nullptr;
  if (!only_.empty()) return load(only_);
  const auto start = absolute_path(fs::path(file)).parent_path();
  const auto [known, is_new] = by_folder_.try_emplace(start.string());
  if (is_new) {
    for (auto folder = start;; folder = folder.parent_path()) {
      std::error_code ignored;
      if (fs::exists(folder / lint_config_name, ignored)) {
        known->second = (folder / lint_config_name).string();
        break;
      }
      if (folder == folder.parent_path()) break;
    }
  }
  if (known->second.empty()) return nullptr;
  return load(known->second);
}

eds::LintPolicy policy_for(const std::string& file, const LintConfig* config,
                           const eds::LintPolicy& options) {
  if (config == nullptr) return options;
  eds::LintPolicy out;
  out.severity = config->severity;
  const auto relative =
      absolute_path(file).lexically_relative(absolute_path(config->path).parent_path()).generic_string();
  for (const auto& allow : config->allow) {
    bool meant = allow.files.empty();
    for (const auto& pattern : allow.files) meant = meant || matches(pattern, relative);
    if (meant) out.off.insert(allow.rule);
  }
  // A severity on the command line switches a rule on again that the configuration allows.
  for (const auto& [rule, severity] : options.severity) {
    out.severity[rule] = severity;
    out.off.erase(rule);
  }
  out.off.insert(options.off.begin(), options.off.end());
  return out;
}

}  // namespace conform::cli
