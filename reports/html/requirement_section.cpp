// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/html/sections.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {
namespace {

std::string one_requirement(const Book& book, const RequirementVerdict& one) {
  const auto* info = book.run().requirement(one.id);
  const auto& cases = book.cases_of(one.id);
  std::string out =
      fmt::format("{}\n<p>{} <b>{}</b> ", requirement_tag(book, one),
                  one.verdict ? badge(*one.verdict) : badge("na", "not judged"), clipped(one.id, 200));
  if (info != nullptr) {
    out += clipped(prose(info->statement), 1000);
    out += fmt::format(" <span class=\"quiet\">{}{}{}</span>", sentence(info->clause),
                       info->clause.empty() || info->level.empty() ? "" : ", ", sentence(info->level));
  }
  if (const auto* cause = book.cause_of(one.id); cause != nullptr) {
    out += fmt::format(" {}", book.cause_link(*cause));
  } else if (one.verdict == result::Verdict::inconclusive) {
    // Not broken, but kept open by what is.
    for (const auto* each : cases) {
      const auto* other = each->verdict == result::Verdict::pass ? nullptr : book.cause_of(*each);
      if (other == nullptr) continue;
      out += fmt::format(" <span class=\"quiet\">open because of</span> {}", book.cause_link(*other));
      break;
    }
  }
  out += "</p>\n";
  if (!cases.empty()) {
    out += folded(fmt::format("{}<span class=\"sr\"> of {}</span>", counted(cases.size(), "case"),
                              clipped(one.id, 200)),
                  book.case_list(cases));
  }
  return out + "</li>\n";
}

}  // namespace

std::string requirement_tag(const Book& book, const RequirementVerdict& one) {
  const auto kind = one.verdict ? css_class(*one.verdict) : std::string_view("na");
  return fmt::format("<li id=\"{}\" data-v=\"{}\">", book.anchor(one.id), kind);
}

std::string requirement_section(const Book& book) {
  const auto areas = tally_by_area(book.run());
  if (areas.empty()) return {};
  // The same names as the areas of the table have, so that each row there finds its list here.
  const auto area_of = [&](const std::string& id) -> std::string {
    const auto* info = book.run().requirement(id);
    if (info == nullptr) return "(not in the catalogue)";
    return info->area.empty() ? "(no area)" : info->area;
  };
  std::string out;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    out += fmt::format("<div class=\"group\">\n<h3 id=\"area-{}\">{}</h3>\n", i + 1,
                       clipped(prose(areas[i].area), 200));
    std::vector<std::string> rows;
    for (const auto& one : book.requirements()) {
      if (area_of(one.id) == areas[i].area) rows.push_back(one_requirement(book, one));
    }
    out += row_lists("requirements", rows) + "</div>\n";
  }
  return section("requirements", "Requirements", out, {"requirement", "requirements"});
}

}  // namespace conform::reports::html
