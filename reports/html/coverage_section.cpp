// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "reports/html/bar.hpp"
#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/html/sections.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {
namespace {

using result::Counts;
using result::RunResult;
using result::Verdict;

constexpr std::string_view head =
    "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Requirements by area\"><table class=\"areas\"><thead><tr>"
    "<th scope=\"col\">area</th><th scope=\"col\"><span class=\"sr\">shares</span></th>"
    "<th scope=\"col\" class=\"num\">judged</th><th scope=\"col\" class=\"num\">pass</th>"
    "<th scope=\"col\" class=\"num\">warn</th><th scope=\"col\" class=\"num\">waived</th>"
    "<th scope=\"col\" class=\"num\">fail</th><th scope=\"col\" class=\"num\">inconclusive</th>"
    "<th scope=\"col\" class=\"num\">error</th><th scope=\"col\" class=\"num\">not applicable</th></tr></thead>\n";

std::string cell(std::size_t number, std::string_view kind = {}) {
  if (number == 0) return "<td class=\"num zero\">0</td>";
  return fmt::format("<td class=\"num{}{}\">{}</td>", kind.empty() ? "" : " is-", kind, number);
}

std::string row(const AreaTally& area, const std::string& name, std::string_view element) {
  const Counts& counts = area.counts;
  const std::size_t judged = counts.pass + counts.waived + counts.warn + counts.fail;
  return fmt::format("<tr><{0} scope=\"row\">{1}</{0}><td>{2}</td>{3}{4}{5}{6}{7}{8}{9}{10}</tr>\n", element,
                     name, bar(counts), cell(judged), cell(counts.pass), cell(counts.warn, "warn"),
                     cell(counts.waived, "waived"), cell(counts.fail, "fail"),
                     cell(counts.inconclusive, "inconclusive"), cell(counts.error, "error"),
                     cell(counts.not_applicable + area.not_judged));
}

std::string table(const Book& book) {
  const auto rows = tally_by_area(book.run());
  if (rows.empty()) return {};
  std::string open, quiet;
  std::size_t quiet_count = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& area = rows[i];
    const auto& counts = area.counts;
    const auto name = link(fmt::format("area-{}", i + 1), clipped(prose(area.area), 200));
    const bool loud = counts.fail + counts.warn + counts.waived + counts.inconclusive + counts.error > 0;
    (loud ? open : quiet) += row(area, name, "th");
    if (!loud) ++quiet_count;
  }
  std::string out(head);
  out += fmt::format("<tbody class=\"all\">{}</tbody>\n<tbody class=\"rest\">\n{}</tbody>\n",
                     row(sum(rows), "all", "th"), open);
  out += "</table></div>\n";
  if (quiet_count > 0)
    out += folded(
        fmt::format("{} more {} without any deviation", quiet_count, quiet_count == 1 ? "area" : "areas"),
        fmt::format("{}<tbody>{}</tbody></table></div>\n", head, quiet));
  return out;
}

/// Each with what became of it, and the cases whose failure it covers.
std::string waivers(const Book& book) {
  std::string items;
  for (const auto& each : book.run().waivers) {
    std::vector<const result::CaseResult*> cases;
    for (const auto& one : book.run().cases) {
      if (std::ranges::find(each.cases, one.name()) != each.cases.end()) cases.push_back(&one);
    }
    const auto line = fmt::format("{} {}", badge(each.verdict), clipped(waiver_text(each), 500));
    items += cases.empty() ? fmt::format("<p>{}</p>\n", line) : folded(line, book.case_list(cases));
  }
  return items.empty() ? items : fmt::format("<h3>Waivers</h3>\n<div class=\"folds\">\n{}</div>\n", items);
}

std::string wants(const RunResult& run) {
  const auto all = tally_wants(run);
  if (all.empty()) return {};
  std::string items;
  for (const auto& each : all)
    items += fmt::format("<li><b>{}</b>: {}</li>\n", counted(each.cases, "case"),
                         clipped(prose(each.want.text), 500));
  return fmt::format("<h3>What to give to have more judged</h3>\n<ul class=\"list\">\n{}</ul>\n", items);
}

std::string reasons(const Book& book) {
  auto groups = group_by_reason(book.run(), Verdict::not_applicable);
  if (groups.empty()) return {};
  std::ranges::stable_sort(groups, std::greater{},
                           [](const ReasonGroup& group) { return group.cases.size(); });
  // Reasons of one case each can be many.
  constexpr std::size_t shown = 12;
  std::string first, rest;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto& group = groups[i];
    (i < shown ? first : rest) +=
        folded(fmt::format("<b>{}</b>: {}{}", counted(group.cases.size(), "case"),
                           clipped(prose(group.reason), 500), group.varies ? ", and the like" : ""),
               book.case_list(group.cases));
  }
  if (!rest.empty()) first += folded(fmt::format("and {} more reasons", groups.size() - shown), rest);
  return fmt::format("<h3>Not applicable, and why</h3>\n<div class=\"folds\">\n{}</div>\n", first);
}

}  // namespace

std::string coverage_section(const Book& book) {
  const std::string content = table(book) + waivers(book) + wants(book.run()) + reasons(book);
  return section("coverage", "Coverage of the requirements", content);
}

}  // namespace conform::reports::html
