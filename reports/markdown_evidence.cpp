// SPDX-License-Identifier: Apache-2.0
#include "reports/markdown.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/cause_lines.hpp"
#include "reports/console.hpp"
#include "reports/markdown_parts.hpp"
#include "reports/markdown_text.hpp"
#include "reports/phrases.hpp"
#include "reports/tally.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports {
namespace {

using result::CaseResult;
using result::Cause;
using result::Counts;
using result::RunResult;
using result::Verdict;

/// A block of text whose fence cannot occur in it: log_safe() lines never hold a line of tildes alone.
std::string block(std::string_view text) { return fmt::format("~~~~~~text\n{}~~~~~~\n", text); }

std::string areas_text(const RunResult& run) {
  const std::vector<AreaTally> rows = tally_by_area(run);
  if (rows.empty()) return {};
  const AreaTally total = sum(rows);
  // Most runs have no waivers.
  const bool waivers = total.counts.waived > 0;
  std::string text = fmt::format(
      "\n| Requirements | pass |{} warn | fail | inconclusive | error | n/a |\n|---|--:|{}--:|--:|--:|--:|--:|\n",
      waivers ? " waived |" : "", waivers ? "--:|" : "");
  const auto cell = [](std::size_t number) {
    return number == 0 ? std::string() : fmt::format("{}", number);
  };
  const auto add = [&](std::string_view name, const Counts& counts) {
    const auto waived = waivers ? fmt::format(" {} |", cell(counts.waived)) : std::string();
    text += fmt::format("| {} | {} |{} {} | {} | {} | {} | {} |\n", name, cell(counts.pass), waived,
                        cell(counts.warn), cell(counts.fail), cell(counts.inconclusive), cell(counts.error),
                        cell(counts.not_applicable));
  };
  for (const AreaTally& row : rows) add(escaped(row.area, 100), row.counts);
  add("**total**", total.counts);
  return text;
}

/// The headline to read, the card of the terminal to unfold.
std::string finding_text(const RunResult& run, const LocatedFinding& located) {
  const result::Finding& finding = *located.finding;
  const result::RequirementInfo* info = run.requirement(finding.requirement);
  std::string text =
      fmt::format("\n**{}**: {}\n", finding.requirement.empty() ? "set-up" : escaped(finding.requirement),
                  escaped(headline(finding)));
  if (info != nullptr) text += fmt::format("{} ({})\n", escaped(info->statement), escaped(info->clause));
  text += fmt::format("Case {}\n\n<details><summary>evidence</summary>\n\n", code(located.owner->name()));
  text += block(finding_card(run, *located.owner, finding, Style{}));
  return text + "\n</details>\n";
}

/// Adds sections until the limit; what is left out is counted.
class Document {
 public:
  explicit Document(std::size_t limit) : limit_(limit) {}
  void add(std::string_view text) { out_ += text; }
  void section(std::string_view title, const std::vector<std::string>& items) {
    if (items.empty()) return;
    out_ += fmt::format("\n### {} ({})\n", title, items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (out_.size() + items[i].size() > limit_) {
        out_ += fmt::format("\n... and {} more, see the other reports of this run\n", items.size() - i);
        return;
      }
      out_ += items[i];
    }
  }
  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  std::size_t limit_;
  std::string out_;
};

/// The finding that the rest rests on, and one line for each further requirement.
std::string cause_text(const RunResult& run, const Beside& beside, const Cause& cause, std::size_t number) {
  std::string text =
      finding_text(run, {cause.primary.owner, cause.primary.finding, cause.primary.verdict, false});
  if (const auto known = likeness_words(run, cause); !known.empty())
    text += fmt::format("\nIt {}.\n", escaped(known, 600));
  if (const auto capture = beside.capture_of(run, cause, number); !capture.empty())
    text += fmt::format("\nFrames for Wireshark: {}\n", code(capture));
  const auto rules = broken_rules(cause);
  if (rules.size() > 1) text += "\nOf the same cause, as far as can be told from outside:\n\n";
  for (std::size_t i = 1; i < rules.size(); ++i) {
    const auto& rule = rules[i];
    text += fmt::format("- {} ({}, {}, first {}): {}\n", escaped(rule.requirement),
                        verdict_words(rule.verdict), counted(rule.cases, "case"),
                        code(rule.first.owner->name()), escaped(headline(*rule.first.finding)));
  }
  if (!cause.resting.empty())
    text += fmt::format("\nNot judged, resting on it: {}, the first {}\n",
                        counted(cause.resting.size(), "case"), code(cause.resting.front()->name()));
  return text;
}

std::vector<std::string> findings_text(const RunResult& run, const Beside& beside,
                                       const std::vector<Cause>& causes, Verdict verdict) {
  std::vector<std::string> items;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    if (causes[i].verdict == verdict) items.push_back(cause_text(run, beside, causes[i], i + 1));
  }
  for (const CaseResult& one : run.cases) {
    if (one.verdict == verdict && findings_of(one).empty())
      items.push_back(fmt::format("\n- {}: {}\n", code(one.name()), escaped(one.reason)));
  }
  return items;
}

std::vector<std::string> unjudged_text(const RunResult& run) {
  std::vector<std::string> items;
  for (const Verdict verdict : {Verdict::error, Verdict::inconclusive}) {
    for (const CaseResult& one : run.cases) {
      if (one.verdict != verdict) continue;
      items.push_back(
          fmt::format("\n- {}: {}, {}", code(one.name()), verdict_words(verdict), escaped(headline(one))));
    }
  }
  if (!items.empty()) items.back() += "\n";
  return items;
}

/// What is not judged, and what would change that: reasons with their numbers of cases, most first.
std::string not_applicable_text(const RunResult& run) {
  std::string text;
  for (const WantTally& each : tally_wants(run))
    text += fmt::format("- {}: {}\n", counted(each.cases, "case"), escaped(each.want.text));
  if (!text.empty()) text.insert(0, "\n### To have more judged\n\n");
  auto groups = group_by_reason(run, Verdict::not_applicable);
  if (groups.empty()) return text;
  std::ranges::stable_sort(groups, std::greater{},
                           [](const ReasonGroup& group) { return group.cases.size(); });
  text += fmt::format("\n<details><summary>not applicable: {}</summary>\n\n",
                      counted(run.counts().not_applicable, "case"));
  constexpr std::size_t most = 60;
  for (std::size_t i = 0; i < std::min(groups.size(), most); ++i) {
    const ReasonGroup& group = groups[i];
    text += fmt::format("- {}: {}{}\n", counted(group.cases.size(), "case"), escaped(group.reason),
                        group.varies ? ", and the like" : "");
  }
  if (groups.size() > most) text += fmt::format("- and {} more reasons\n", groups.size() - most);
  return text + "\n</details>\n";
}

/// A row for each case of CiA's tool.
std::string compared_text(const RunResult& run) {
  if (run.compared.empty()) return {};
  std::string text = "\n### What CiA's tool would say\n\n| case | | outcome | |\n|---|---|---|---|\n";
  for (const auto& each : run.compared) {
    text += fmt::format("| {} | {}: {} | {} | {} |\n", each.number, escaped(each.group), escaped(each.title),
                        each.outcome, escaped(each.because));
  }
  return text;
}

std::string facts_text(const RunResult& run) {
  if (run.properties.empty()) return {};
  std::string text = "\n<details><summary>device, bus and run</summary>\n\n| | |\n|---|---|\n";
  for (const result::Property& property : run.properties) {
    if (is_of_the_machine(property)) continue;
    text += fmt::format("| {} | {} |\n", escaped(property.name), escaped(property.value));
  }
  return text + "\n</details>\n";
}

}  // namespace

std::string markdown_evidence(const RunResult& run, const Beside& beside, const MarkdownOptions& options) {
  Document document(options.size_limit);
  document.add(markdown_head(run));
  const auto causes = result::causes_of(run);
  document.add(markdown_causes(run, causes, causes.size()));
  document.add(areas_text(run));
  document.add(markdown_waivers(run, run.waivers.size()));
  document.add(compared_text(run));
  document.add(not_applicable_text(run));
  document.add(facts_text(run));
  for (std::size_t i = 0; i < run.notes.size(); ++i) {
    document.add(fmt::format("{}- {}\n", i == 0 ? "\n" : "", escaped(run.notes[i])));
  }
  document.section("Failures", findings_text(run, beside, causes, Verdict::fail));
  document.section("Not judged", unjudged_text(run));
  document.section("Warnings", findings_text(run, beside, causes, Verdict::warn));
  return document.take();
}

}  // namespace conform::reports
