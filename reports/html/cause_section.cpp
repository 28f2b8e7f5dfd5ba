// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "reports/html/card.hpp"
#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/html/sections.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {
namespace {

using result::Cause;

std::string rules_table(const Book& book, const Cause& cause) {
  const auto rules = broken_rules(cause);
  if (rules.size() < 2) return {};
  std::string rows;
  for (std::size_t i = 1; i < rules.size(); ++i) {
    const auto& rule = rules[i];
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"num\">{}</td><td>{}</td><td>{}</td></tr>\n",
                        badge(rule.verdict), book.requirement_link(rule.requirement), rule.cases,
                        book.case_link(*rule.first.owner), clipped(headline(*rule.first.finding), 300));
  }
  return fmt::format(
      "<h4>Also broken, of the same cause as far as can be told from outside</h4>\n"
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Requirements broken by cause {}\"><table><thead><tr>"
      "<th scope=\"col\">verdict</th><th scope=\"col\">requirement</th><th scope=\"col\" class=\"num\">cases</th>"
      "<th scope=\"col\">first</th><th scope=\"col\">what came</th></tr></thead><tbody>\n{}</tbody></table></div>\n",
      book.number_of(cause), rows);
}

/// A mistake that somebody made before, in words.
std::string known_mistakes(const Book& book, const Cause& cause) {
  const auto all = likenesses(book.run(), cause);
  if (all.empty()) return {};
  std::string items;
  for (const auto* each : all) {
    items += fmt::format("<li><code>{}</code>: {} <span class=\"quiet\">({} % alike)</span></li>\n",
                         clipped(each->name, 100), clipped(prose(each->summary), 300), each->percent);
  }
  return fmt::format(
      "<div class=\"known\">\n<h4>Looks like {} of the reference node</h4>\n<ul class=\"list\">\n{}</ul>\n</div>\n",
      all.size() == 1 ? "a known defect" : "one of these known defects", items);
}

/// A link to the frames, where they were written beside the report.
std::string capture_link(const Book& book, const Cause& cause) {
  const auto path = book.beside().capture_of(book.run(), cause, book.number_of(cause));
  if (path.empty()) return {};
  return fmt::format("<p class=\"quiet\">Frames for Wireshark: <a href=\"{}\">{}</a></p>\n",
                     text(url_path(path)), clipped(path, 300));
}

std::string one_cause(const Book& book, const Cause& cause) {
  const LocatedFinding primary{cause.primary.owner, cause.primary.finding, cause.primary.verdict, false};
  const std::string anchor = book.anchor(cause);
  std::string out = fmt::format(
      "<article class=\"cause {}\" id=\"{}\" data-v=\"{}\" aria-labelledby=\"{}-title\">\n<h3 id=\"{}-title\">{} "
      "<span class=\"no\">{}.</span> {}</h3>\n<p class=\"headline\">{}</p>\n<p class=\"quiet\">{}</p>\n",
      css_class(cause.verdict), anchor, css_class(cause.verdict), anchor, anchor, badge(cause.verdict),
      book.number_of(cause), clipped(cause.about, 300), clipped(headline(*cause.primary.finding), 600),
      text(extent(cause)));
  out += known_mistakes(book, cause);
  out += card(book, primary) + capture_link(book, cause) + rules_table(book, cause);
  if (cause.cases.size() > 1)
    out += folded(fmt::format("{} with a finding of this cause", counted(cause.cases.size(), "case")),
                  book.case_list(cause.cases));
  if (!cause.resting.empty())
    out += folded(fmt::format("{} not judged, resting on it", counted(cause.resting.size(), "case")),
                  book.case_list(cause.resting));
  return out + "</article>\n";
}

/// What failed without a finding, and the environment: nothing of it has a cause.
std::string bare_cases(const Book& book) {
  std::string items;
  for (const auto verdict : {result::Verdict::fail, result::Verdict::warn, result::Verdict::error}) {
    for (const auto& group : group_by_reason(book.run(), verdict)) {
      std::vector<const result::CaseResult*> bare;
      for (const auto* one : group.cases) {
        if (book.cause_of(*one) == nullptr) bare.push_back(one);
      }
      if (bare.empty()) continue;
      items += folded(fmt::format("{} <b>{}</b>: {}", badge(verdict), counted(bare.size(), "case"),
                                  clipped(prose(group.reason), 500)),
                      book.case_list(bare));
    }
  }
  return items.empty() ? items
                       : fmt::format("<h3>Without a cause</h3>\n<div class=\"folds\">\n{}</div>\n", items);
}

}  // namespace

std::string cause_section(const Book& book) {
  std::string content;
  for (const Cause& cause : book.causes()) content += one_cause(book, cause);
  content += bare_cases(book);
  return section("causes", "Causes", content, {"cause", "causes"});
}

}  // namespace conform::reports::html
