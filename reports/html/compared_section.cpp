// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <fmt/format.h>

#include "reports/html/markup.hpp"
#include "reports/html/sections.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {
namespace {

/// The class whose shape an outcome of the other tool is shown with.
std::string_view kind_of(std::string_view outcome) {
  struct Row {
    std::string_view outcome, kind;
  };
  constexpr std::array rows{Row{"passed", "pass"}, Row{"warning", "warn"}, Row{"failed", "fail"},
                            Row{"not decided", "inconclusive"}};
  for (const auto& row : rows) {
    if (row.outcome == outcome) return row.kind;
  }
  return "na";
}

/// The cases here that it rests on; of many the first ones, and the rest to unfold.
std::string cases_of(const Book& book, const result::ComparedCase& one) {
  constexpr std::size_t shown = 2;
  std::string first, rest;
  for (std::size_t i = 0; i < one.cases.size(); ++i)
    (i < shown || one.cases.size() == shown + 1 ? first : rest) += book.case_link(one.cases[i]) + "<br/>";
  if (rest.empty()) return first;
  return first + folded(fmt::format("{} more", one.cases.size() - shown), rest);
}

}  // namespace

std::string compared_section(const Book& book) {
  const auto& compared = book.run().compared;
  if (compared.empty()) return {};
  std::string rows;
  for (const auto& each : compared) {
    rows +=
        fmt::format("<tr><td>{}</td><td>{}</td><td>{}: {}{}{}</td><td>{}</td></tr>\n", text(each.number),
                    badge(kind_of(each.outcome), each.outcome), sentence(each.group), sentence(each.title),
                    each.because.empty() ? "" : "<br/>", sentence(each.because), cases_of(book, each));
  }
  return fmt::format(
      "<section id=\"compared\" aria-labelledby=\"compared-title\">\n<h2 id=\"compared-title\">What CiA's tool would say"
      "</h2>\n<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Cases of CiA's tool\">"
      "<table class=\"compared\"><thead><tr><th scope=\"col\">case</th><th scope=\"col\">outcome</th>"
      "<th scope=\"col\">what it is about</th><th scope=\"col\">rests on</th></tr></thead><tbody>\n{}</tbody></table></div>\n"
      "</section>\n",
      rows);
}

}  // namespace conform::reports::html
