// SPDX-License-Identifier: Apache-2.0
#include "eds/lint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <tuple>
#include <utility>

#include "base/in_parallel.hpp"
#include "base/text.hpp"
#include "eds/expand.hpp"
#include "eds/lint_comments.hpp"
#include "eds/lint_roots.hpp"
#include "eds/lint_rules.hpp"
#include "eds/same_value.hpp"

namespace conform::eds {
namespace {

/// The order of the page.
constexpr std::array groups = {
    &structure_rules,  &number_rules,     &value_rules,   &info_rules,  &list_rules,    &object_rules,
    &predefined_rules, &sub_object_rules, &compact_rules, &pdo_rules,   &mapping_rules, &identity_rules,
    &module_rules,     &presence_rules,   &cob_id_rules,  &entry_rules, &xdd_rules,
};

/// Objects of a file of which the groups are looked at side by side; those of a smaller one are done before
/// another thread has begun.
constexpr std::size_t worth_threads = 500;

std::vector<RuleGroup> tables() {
  std::vector<RuleGroup> out;
  for (const auto* group : groups) out.push_back(group->table);
  return out;
}

}  // namespace

std::string_view to_string(Severity severity) {
  switch (severity) {
    case Severity::note: return "note";
    case Severity::warning: return "warning";
    case Severity::error: return "error";
  }
  return "note";
}

std::size_t LintReport::count(Severity severity) const {
  return static_cast<std::size_t>(std::ranges::count_if(
      findings, [severity](const auto& finding) { return finding.severity() == severity; }));
}

void Findings::add(const Rule& rule, Position at, std::string message, std::string hint) {
  // What the file leaves out altogether is a matter of its first line.
  if (!at.known()) at = {1, 1};
  if (!known_.emplace(at, &rule, message).second) return;
  if (++counts_[&rule] > most_of_a_rule) {
    ++report_.left_out;
    ++report_.left_out_of[&rule];
    return;
  }
  report_.findings.push_back({&rule, at, std::move(message), std::move(hint)});
}

void Findings::join(Findings other) {
  auto& more = other.report_;
  std::ranges::move(more.findings, std::back_inserter(report_.findings));
  report_.left_out += more.left_out;
  for (const auto& [rule, count] : more.left_out_of) report_.left_out_of[rule] += count;
}

LintReport Findings::finish() {
  std::ranges::sort(report_.findings, [](const Finding& a, const Finding& b) {
    return std::tie(a.at, a.rule->code, a.message) < std::tie(b.at, b.rule->code, b.message);
  });
  return std::move(report_);
}

LintReport lint(const EdsFile& file) {
  // Most files write everything out: then there is nothing to copy.
  const auto expanded = implies_entries(file) ? expand(file) : std::vector<Object>();
  const bool in_full = expanded && !expanded->empty();
  Subject subject{file, in_full ? *expanded : file.objects, {}, {}, configured_node(file)};
  if (!expanded) {
    subject.expansion_fault = expanded.error().what;
    for (const auto& object : file.objects) {
      if (!subject.expansion_at.known()) subject.expansion_at = object.compact_sub_obj.at;
    }
  }
  std::array<Findings, groups.size()> found;
  const unsigned jobs = file.objects.size() < worth_threads ? 1 : 0;
  in_parallel(groups.size(), jobs, [&](std::size_t i) { groups[i]->check(subject, found[i]); });
  Findings findings;
  for (auto& each : found) findings.join(std::move(each));
  auto report = findings.finish();
  mark_roots(file, report);
  return report;
}

std::span<const RuleGroup> rule_groups() {
  static const auto all = tables();
  return all;
}

std::span<const RuleGroup> all_rule_groups() {
  static const auto all = [] {
    auto out = tables();
    out.push_back(comment_rules);
    return out;
  }();
  return all;
}

const Rule* find_rule(std::string_view code) {
  for (const auto& group : all_rule_groups()) {
    for (const auto* rule : group.rules) {
      if (rule->code == code) return rule;
    }
  }
  return nullptr;
}

std::string lint_table_markdown() {
  std::string out =
      "# Lint of device descriptions\n\n"
      "`canopen-conform eds lint FILE` checks EDS, DCF, XDD and XDC. A finding is an opinion about the file, never about the "
      "device. Codes are never given to another rule.\n\n"
      "| severity | meaning |\n|---|---|\n"
      "| error | the file contradicts the standard or itself |\n"
      "| warning | legal or not, tools will disagree about it |\n"
      "| note | worth a look |\n\n"
      "`canopen-conform explain EDS254` says more about a rule. How a rule is allowed or given another severity, and how the lint is kept in CI: "
      "[eds-lint-in-ci.md](eds-lint-in-ci.md).\n";
  for (const auto& group : all_rule_groups()) {
    out += fmt::format("\n## {}\n\n| code | severity | mistake | source |\n|---|---|---|---|\n", group.title);
    for (const auto* rule : group.rules)
      out += fmt::format("| <a id=\"{}\"></a>{} | {} | {} | {} |\n", lower(rule->code), rule->code,
                         to_string(rule->severity), rule->title, rule->source);
  }
  return out;
}

std::string section_name(Index index, std::optional<SubIndex> sub) {
  if (sub) return fmt::format("[{:04X}sub{:X}]", index.value(), sub->value());
  return fmt::format("[{:04X}]", index.value());
}

void each_described(const Subject& subject, const std::function<void(const Spot&)>& look) {
  for (const auto& object : subject.file.objects) {
    if (object.described) look({object, {}, object.entry});
    for (const auto& sub : object.subs) look({object, sub.sub, sub.entry});
  }
  for (const auto& module : subject.file.modules) {
    for (const auto& object : module.fixed_objects) {
      if (object.described) look({object, {}, object.entry, Spot::Kind::fixed, module.number});
      for (const auto& sub : object.subs)
        look({object, sub.sub, sub.entry, Spot::Kind::fixed, module.number});
    }
    for (const auto& extension : module.extensions) {
      Object object;
      object.index = extension.index;
      look({object, {}, extension.entry, Spot::Kind::extension, module.number});
    }
  }
}

const NumberedField* first_out_of_row(const NumberedList& list) {
  std::vector<const NumberedField*> entries;
  entries.reserve(list.entries.size());
  for (const auto& entry : list.entries) entries.push_back(&entry);
  std::ranges::sort(entries, {},
                    [](const auto* entry) { return std::tie(entry->number, entry->field.key_at); });
  std::uint64_t expected = 1;
  for (const auto* entry : entries) {
    if (entry->number + 1 == expected) continue;
    if (entry->number != expected) return entry;
    ++expected;
  }
  return nullptr;
}

std::string RemarkRow::text_of(const Remark& remark) const {
  return fmt::format(fmt::runtime(message), remark.detail);
}

const RemarkRow* row_of(std::span<const RemarkRow> rows, const Remark& remark) {
  const auto found = std::ranges::find(rows, remark.what, &RemarkRow::what);
  return found == rows.end() ? nullptr : &*found;
}

std::string Spot::name() const {
  auto own = section_name(object.index, sub);
  if (kind == Kind::of_the_device) return own;
  return fmt::format("[M{}{}{}", module, kind == Kind::fixed ? "Fixed" : "SubExt", own.substr(1));
}

const Field& effective_value(const Entry& entry) {
  return entry.parameter_value.empty() ? entry.default_value : entry.parameter_value;
}

std::optional<Number> cob_id_of(const Field& field) {
  const auto number = parse_number(field.text);
  return number && !number->negative ? std::optional(*number) : std::nullopt;
}

}  // namespace conform::eds
