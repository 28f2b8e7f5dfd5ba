// SPDX-License-Identifier: Apache-2.0
#include "reports/console.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/cause_lines.hpp"
#include "reports/paint.hpp"
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

/// Short enough for a column; in the order in which people look for them.
struct Column {
  Verdict verdict;
  std::string_view label;
  std::size_t Counts::* count;
};
constexpr std::array<Column, 7> verdict_columns{{{Verdict::pass, "pass", &Counts::pass},
                                                 {Verdict::waived, "waived", &Counts::waived},
                                                 {Verdict::warn, "warn", &Counts::warn},
                                                 {Verdict::fail, "fail", &Counts::fail},
                                                 {Verdict::inconclusive, "inconcl", &Counts::inconclusive},
                                                 {Verdict::error, "error", &Counts::error},
                                                 {Verdict::not_applicable, "n/a", &Counts::not_applicable}}};
constexpr std::size_t label_width = 7;
constexpr std::size_t value_limit = 400;  // columns of a value or an item; the report files have the rest

std::string_view short_label(Verdict verdict) {
  return std::ranges::find(verdict_columns, verdict, &Column::verdict)->label;
}

std::string requirement_list(const CaseResult& one) {
  constexpr std::size_t shown = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(one.requirements.size(), shown); ++i) {
    text += (i == 0 ? "" : ", ") + log_safe(one.requirements[i]);
  }
  if (one.requirements.size() > shown) text += fmt::format(" +{}", one.requirements.size() - shown);
  return text;
}

/// "3 fail, 1 warn, 20 pass": what is not there is not mentioned.
std::string counts_text(const Counts& counts, const Style& style) {
  constexpr std::array order{Verdict::fail,   Verdict::error, Verdict::inconclusive,  Verdict::warn,
                             Verdict::waived, Verdict::pass,  Verdict::not_applicable};
  std::string text;
  for (const Verdict verdict : order) {
    const Column& column = *std::ranges::find(verdict_columns, verdict, &Column::verdict);
    const std::size_t number = counts.*column.count;
    if (number == 0) continue;
    text += text.empty() ? "" : ", ";
    text += paint(fmt::format("{} {}", number, verdict_words(column.verdict)), ink_of(column.verdict), style);
  }
  return text.empty() ? "none" : text;
}

class Page {
 public:
  explicit Page(const Style& style) : style_(style), width_(std::max<std::size_t>(style.width, 60)) {}

  void line(std::string_view text = {}) { out_ += std::string(text) + "\n"; }
  void heading(std::string_view text) {
    if (!out_.empty()) line();
    const std::string shown = clip(text, width_);
    line(paint(shown, Ink::strong, style_));
    line(paint(std::string(columns(shown), '-'), Ink::dim, style_));
  }
  void row(std::string_view label, std::string_view value, std::size_t label_columns) {
    const std::string name = clip(label, label_columns);
    bool first = true;
    for (const std::string& part : wrap(clip(value, value_limit), width_ - label_columns - 2)) {
      line(pad_right(first ? name : "", label_columns) + "  " + part);
      first = false;
    }
  }
  /// Text that is already painted; it cannot be measured, so it is not wrapped.
  void painted_row(std::string_view label, std::string_view value, std::size_t label_columns) {
    line(pad_right(label, label_columns) + "  " + std::string(value));
  }
  void item(std::string_view text, std::string_view mark = "- ") {
    bool first = true;
    for (const std::string& part : wrap(clip(text, value_limit), width_ - mark.size())) {
      line((first ? std::string(mark) : std::string(mark.size(), ' ')) + part);
      first = false;
    }
  }
  void text(std::string_view text) { out_ += text; }
  [[nodiscard]] const Style& style() const { return style_; }
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  const Style& style_;
  std::size_t width_;
  std::string out_;
};

void write_subject(Page& page, const RunResult& run) {
  page.heading(log_safe(run.tool) + (run.device.empty() ? "" : ": " + log_safe(run.device)));
  std::size_t label = 0;
  for (const result::Property& property : run.properties) {
    label = std::clamp(columns(log_safe(property.name)), label, std::size_t{32});
  }
  for (const result::Property& property : run.properties) {
    if (!is_of_the_machine(property)) page.row(log_safe(property.name), log_safe(property.value), label);
  }
}

/// Most runs have no waivers, and the table should fit a terminal.
std::vector<Column> columns_of(const AreaTally& total) {
  std::vector<Column> out(verdict_columns.begin(), verdict_columns.end());
  if (total.counts.waived == 0)
    std::erase_if(out, [](const Column& each) { return each.verdict == Verdict::waived; });
  return out;
}

void write_table_row(Page& page, const AreaTally& row, const std::vector<Column>& shown,
                     std::size_t area_width, Ink area_ink) {
  bool first = true;
  for (const std::string& part : wrap(clip(prose(row.area), value_limit / 4), area_width)) {
    std::string line = paint(first ? pad_right(part, area_width) : part, area_ink, page.style());
    for (const Column& column : shown) {
      if (!first) break;
      const std::size_t number = row.counts.*column.count;
      const std::string cell = pad_left(number == 0 ? "." : fmt::format("{}", number), label_width + 2);
      line += paint(cell, number == 0 ? Ink::dim : ink_of(column.verdict), page.style());
    }
    page.line(line);
    first = false;
  }
}

void write_areas(Page& page, const RunResult& run) {
  const std::vector<AreaTally> rows = tally_by_area(run);
  if (rows.empty()) return;
  page.heading("Requirements by area");
  const AreaTally total = sum(rows);
  const std::vector<Column> shown = columns_of(total);
  const std::size_t numbers = shown.size() * (label_width + 2);
  std::size_t area_width = columns("total");
  for (const AreaTally& row : rows) area_width = std::max(area_width, columns(prose(row.area)));
  area_width = page.width() > numbers + 8 ? std::min(area_width, page.width() - numbers) : 8;
  std::string head(area_width, ' ');
  for (const Column& column : shown) head += pad_left(column.label, label_width + 2);
  page.line(paint(head, Ink::dim, page.style()));
  for (const AreaTally& row : rows) write_table_row(page, row, shown, area_width, Ink::plain);
  write_table_row(page, total, shown, area_width, Ink::strong);
  if (total.not_judged != 0) {
    page.item(fmt::format("{} not judged: the device took a branch that does not decide {}.",
                          counted(total.not_judged, "requirement"), total.not_judged == 1 ? "it" : "them"),
              "");
  }
}

void write_card_list(Page& page, const RunResult& run, const std::vector<LocatedFinding>& all) {
  const std::size_t most = page.style().cards == 0 ? all.size() : std::min(all.size(), page.style().cards);
  for (std::size_t i = 0; i < most; ++i) {
    if (i != 0) page.line();
    page.text(finding_card(run, *all[i].owner, *all[i].finding, page.style()));
  }
  if (most < all.size())
    page.line(fmt::format("\n... and {} more, in full in the report files", all.size() - most));
}

/// One cause: the card of what the rest rests on, and a line for each further requirement.
void write_cause(Page& page, const RunResult& run, const Cause& cause) {
  page.text(finding_card(run, *cause.primary.owner, *cause.primary.finding, page.style()));
  if (const auto known = likeness_words(run, cause); !known.empty()) page.item(known, "  ");
  const auto rules = broken_rules(cause);
  constexpr std::size_t named = 12;
  if (rules.size() > 1) page.line("  also broken, of the same cause as far as can be told from outside:");
  for (std::size_t i = 1; i < std::min(rules.size(), named); ++i) {
    const auto& rule = rules[i];
    page.item(fmt::format("{} ({}, {}): {}", log_safe(rule.requirement), verdict_words(rule.verdict),
                          counted(rule.cases, "case"), headline(*rule.first.finding)),
              "    ");
    const auto& described = rule.first.finding->declared_at;
    if (!described.empty()) page.item("described " + log_safe(described), "      ");
  }
  if (rules.size() > named) page.item(fmt::format("and {} more requirements", rules.size() - named), "    ");
  if (cause.resting.empty()) return;
  page.item(fmt::format("not judged, because {} on it: {}, the first {}",
                        cause.resting.size() == 1 ? "it rests" : "they rest",
                        counted(cause.resting.size(), "case"), log_safe(cause.resting.front()->name())),
            "  ");
}

/// Causes of one verdict, as a list and then one by one; a case without findings tells its reason instead.
void write_causes(Page& page, const RunResult& run, const std::vector<Cause>& causes, Verdict verdict,
                  std::string_view title) {
  std::vector<const Cause*> chosen;
  for (const Cause& cause : causes) {
    if (cause.verdict == verdict) chosen.push_back(&cause);
  }
  std::vector<const CaseResult*> bare;
  for (const CaseResult& one : run.cases) {
    if (one.verdict == verdict && findings_of(one).empty()) bare.push_back(&one);
  }
  if (chosen.empty() && bare.empty()) return;
  page.heading(fmt::format("{}: {}", title, counted(chosen.size() + bare.size(), "cause")));
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Cause& cause = *chosen[i];
    page.item(fmt::format("{}: {}, {}; {}", log_safe(cause.primary.finding->requirement), prose(cause.about),
                          extent(cause), headline(*cause.primary.finding)),
              fmt::format("{}. ", i + 1));
  }
  for (const CaseResult* one : bare) page.item(log_safe(one->name()) + ": " + prose(one->reason));
  const std::size_t most =
      page.style().cards == 0 ? chosen.size() : std::min(chosen.size(), page.style().cards);
  for (std::size_t i = 0; i < most; ++i) {
    page.line();
    write_cause(page, run, *chosen[i]);
  }
  if (most < chosen.size())
    page.line(fmt::format("\n... and {} more, in full in the report files", chosen.size() - most));
}

/// Cases without verdict by reason: a long list with one cause is one item.
void write_unjudged_cases(Page& page, const RunResult& run) {
  for (const Verdict verdict : {Verdict::error, Verdict::inconclusive}) {
    for (const ReasonGroup& group : group_by_reason(run, verdict)) {
      std::string text = fmt::format("{}: {}", verdict_words(verdict), prose(group.reason));
      if (is_not_run(*group.cases.front()) && run.aborted) text += ", " + prose(*run.aborted);
      page.item(text);
      constexpr std::size_t named = 5;
      for (std::size_t i = 0; i < std::min(group.cases.size(), named); ++i) {
        page.item(log_safe(group.cases[i]->name()), "    ");
      }
      if (group.cases.size() > named)
        page.item(fmt::format("and {} more", group.cases.size() - named), "    ");
    }
  }
}

void write_unjudged(Page& page, const RunResult& run) {
  std::vector<LocatedFinding> all;
  for (const CaseResult& one : run.cases) {
    const auto findings = findings_of(one);
    std::ranges::copy_if(findings, std::back_inserter(all), [](const LocatedFinding& located) {
      return located.setup || located.verdict == Verdict::inconclusive || located.verdict == Verdict::error;
    });
  }
  const Counts counts = run.counts();
  const std::size_t unjudged = counts.error + counts.inconclusive;
  if (unjudged == 0 && all.empty()) return;
  page.heading(unjudged == 0 ? "Steps that could not be done"
                             : fmt::format("Not judged ({}): this says nothing about the device yet",
                                           counted(unjudged, "case")));
  write_unjudged_cases(page, run);
  if (unjudged != 0 && !all.empty()) page.line();
  write_card_list(page, run, all);
}

void write_not_applicable(Page& page, const RunResult& run) {
  auto groups = group_by_reason(run, Verdict::not_applicable);
  if (groups.empty()) return;
  std::ranges::stable_sort(groups, std::greater{},
                           [](const ReasonGroup& group) { return group.cases.size(); });
  page.heading(fmt::format("Not applicable ({})", counted(run.counts().not_applicable, "case")));
  constexpr std::size_t most = 12;
  for (std::size_t i = 0; i < std::min(groups.size(), most); ++i) {
    page.item(fmt::format("{}: {}{}", counted(groups[i].cases.size(), "case"), prose(groups[i].reason),
                          groups[i].varies ? ", and the like" : ""));
  }
  if (groups.size() > most)
    page.item(fmt::format("and {} more reasons, listed in the report files", groups.size() - most));
}

/// What the user could give: the shortest way to more verdicts, so it stands where it is seen.
void write_wants(Page& page, const RunResult& run) {
  const auto wants = tally_wants(run);
  if (wants.empty()) return;
  page.heading("To have more judged");
  constexpr std::size_t most = 10;
  for (std::size_t i = 0; i < std::min(wants.size(), most); ++i)
    page.item(fmt::format("{}: {}", counted(wants[i].cases, "case"), prose(wants[i].want.text)));
  if (wants.size() > most)
    page.item(fmt::format("and {} more, listed in the report files", wants.size() - most));
}

/// Each with what became of it; those that ask for a look first.
void write_waivers(Page& page, const RunResult& run) {
  if (run.waivers.empty()) return;
  page.heading("Waivers");
  auto all = run.waivers;
  std::ranges::stable_sort(all, std::greater{}, &result::WaiverUse::verdict);
  for (const auto& each : all) page.item(waiver_text(each));
}

/// What the exit code says, for a person who does not know the table.
std::string exit_text(const RunResult& run, int code) {
  const Counts counts = run.counts();
  switch (code) {
    case 0:
      if (const auto waived = run.waived(); !waived.empty())
        return fmt::format("what was judged conforms, but for {} that {} waived: {}",
                           counted(waived.size(), "violated requirement"), waived.size() == 1 ? "is" : "are",
                           join(waived, ", "));
      return counts.warn == 0 ? "everything that was judged conforms"
                              : "everything that was judged conforms, with warnings";
    case 1:
      return counts.fail == 0 ? "a waiver asks for a look (--strict)"
                              : "the device violates at least one requirement";
    case 2:
      if (run.cases.empty()) return "nothing was selected, so nothing was judged";
      return run.without_time() ? "nothing that was selected fits into the --budget, so nothing was judged"
                                : "nothing selected applies to this device, so nothing was judged";
    case 3:
      if (!run.unwritten.empty() && !run.aborted && counts.error + counts.inconclusive == 0)
        return "a report could not be written; no requirement is known to be violated";
      return run.aborted ? "the run stopped early; no requirement is known to be violated"
                         : "no requirement is known to be violated, but not everything could be judged";
    case 130: return "interrupted (SIGINT)";
    case 143: return "terminated (SIGTERM)";
    default: return fmt::format("ended by signal {}", run.signal);
  }
}

/// A line for each case of the other tool, its numbers before them.
void write_compared(Page& page, const RunResult& run) {
  if (run.compared.empty()) return;
  page.heading("What CiA's tool would say");
  constexpr std::size_t label = 20;
  std::map<std::string_view, std::size_t> tally;
  for (const auto& each : run.compared) {
    ++tally[each.outcome];
    std::string text = each.group + ": " + each.title;
    if (!each.because.empty()) text += " (" + log_safe(each.because) + ")";
    page.row(fmt::format("{:6} {}", each.number, each.outcome), text, label);
  }
  std::vector<std::string> parts;
  for (const std::string_view outcome :
       {"passed", "warning", "failed", "not decided", "skipped", "no counterpart"}) {
    if (tally[outcome] > 0) parts.push_back(fmt::format("{} {}", tally[outcome], outcome));
  }
  page.line();
  page.line(fmt::format("{} cases of CiA's tool: {}", run.compared.size(), join(parts, ", ")));
}

void write_totals(Page& page, const RunResult& run) {
  constexpr std::size_t label = 12;
  const Style& style = page.style();
  page.heading("Result");
  page.painted_row("cases", fmt::format("{}: {}", run.cases.size(), counts_text(run.counts(), style)), label);
  const AreaTally total = sum(tally_by_area(run));
  page.painted_row(
      "requirements",
      fmt::format("{}: {}", total.counts.total() + total.not_judged, counts_text(total.counts, style)),
      label);
  page.row("bus time", brief_duration(run.elapsed), label);
  for (std::size_t i = 0; i < run.notes.size(); ++i)
    page.row(i == 0 ? "notes" : "", prose(run.notes[i]), label);
  if (run.aborted) page.row("stopped", prose(*run.aborted), label);
  for (std::size_t i = 0; i < run.unwritten.size(); ++i)
    page.row(i == 0 ? "not written" : "", log_safe(run.unwritten[i]), label);
  const int code = result::exit_code(run);
  const Ink ink = code == 0 ? Ink::good : code == 1 ? Ink::bad : Ink::unsure;
  page.painted_row("exit code", paint(fmt::format("{}: {}", code, exit_text(run, code)), ink, style), label);
}

}  // namespace

std::string case_line(const CaseResult& one, const Style& style) {
  std::string line = paint(pad_right(short_label(one.verdict), label_width), ink_of(one.verdict), style);
  line += "  " + log_safe(one.name());
  const std::string requirements = requirement_list(one);
  if (!requirements.empty()) line += "  " + paint(requirements, Ink::dim, style);
  if (one.verdict != Verdict::not_applicable && !is_not_run(one))
    line += "  " + brief_duration(one.end - one.begin);
  if (!one.tried.empty()) line += "  tried " + paint(prose(one.tried), Ink::dim, style);
  if (one.verdict == Verdict::pass) return line;
  constexpr std::size_t reason_width = 160;
  const std::string why = clip(headline(one), reason_width);
  return why.empty() ? line
                     : line + "  " + paint(why, one.verdict == Verdict::fail ? Ink::bad : Ink::plain, style);
}

std::string summary(const RunResult& run, const Style& style) {
  Page page(style);
  write_subject(page, run);
  write_areas(page, run);
  // The worst comes last: it is what a terminal shows when the run is over.
  write_compared(page, run);
  write_not_applicable(page, run);
  write_unjudged(page, run);
  const auto causes = result::causes_of(run);
  write_causes(page, run, causes, Verdict::warn, "Warnings");
  write_causes(page, run, causes, Verdict::fail, "Failures");
  write_wants(page, run);
  write_waivers(page, run);
  write_totals(page, run);
  return page.take();
}

std::string clock_words(Duration time) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time).count();
  if (seconds >= 3600) return fmt::format("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
  return fmt::format("{}:{:02}", seconds / 60, seconds % 60);
}

std::string about(Duration time) {
  const auto seconds = std::chrono::ceil<std::chrono::seconds>(time).count();
  if (seconds < 10) return fmt::format("{} s", seconds);
  if (seconds < 90) return fmt::format("{} s", (seconds + 9) / 10 * 10);
  const auto minutes = (seconds + 59) / 60;
  return minutes < 90 ? fmt::format("{} min", minutes) : fmt::format("{} h", (minutes + 30) / 60);
}

std::string progress(std::size_t number, std::size_t total, std::string_view times, std::string_view name,
                     const Counts& counts, const Style& style) {
  const std::string of = fmt::format("{}", total);
  std::string plain = fmt::format("[{}/{}]", pad_left(fmt::format("{}", number), of.size()), of);
  if (!times.empty()) plain += fmt::format("  {}", times);
  std::string painted = plain;
  for (const Verdict verdict : {Verdict::fail, Verdict::error, Verdict::inconclusive, Verdict::warn}) {
    const Column& column = *std::ranges::find(verdict_columns, verdict, &Column::verdict);
    if (counts.*column.count == 0) continue;
    const std::string part = fmt::format("{} {}", counts.*column.count, column.label);
    plain += "  " + part;
    painted += "  " + paint(part, ink_of(verdict), style);
  }
  const std::size_t used = columns(plain) + 2;
  if (used >= style.width) return clip(plain, style.width);
  return painted + "  " + clip_front(log_safe(name), style.width - used);
}

}  // namespace conform::reports
