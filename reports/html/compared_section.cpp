// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "reports/html/markup.hpp"
#include "reports/html/outcomes.hpp"
#include "reports/html/sections.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {

std::span<const std::string_view> outcomes_of_the_other_tool() {
  static constexpr std::array<std::string_view, 6> all{"failed", "warning", "not decided",
                                                       "passed", "skipped", "no counterpart"};
  return all;
}

std::string outcome_badge(std::string_view outcome) {
  constexpr std::array<std::string_view, 4> kinds{"fail", "warn", "inconclusive", "pass"};
  const auto all = outcomes_of_the_other_tool();
  const auto at = static_cast<std::size_t>(std::ranges::find(all, outcome) - all.begin());
  return badge(at < kinds.size() ? kinds.at(at) : "na", outcome);
}

namespace {

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
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}: {}{}{}</td><td>{}</td></tr>\n", text(each.number),
                        outcome_badge(each.outcome), sentence(each.group), sentence(each.title),
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
