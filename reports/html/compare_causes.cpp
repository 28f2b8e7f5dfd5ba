// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/cause_lines.hpp"
#include "reports/html/card.hpp"
#include "reports/html/compare_sections.hpp"
#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {
namespace {

using result::Place;

constexpr std::size_t text_limit = 300;

std::string article_begin(std::string_view kind, std::string_view row, const std::string& anchor,
                          result::Verdict verdict, std::size_t number, const std::string& about) {
  return fmt::format(
      "<article class=\"cause {0}\" id=\"{1}\" data-v=\"{2}\" aria-labelledby=\"{1}-title\">\n<h3 id=\"{1}-title\">{3} "
      "<span class=\"no\">{4}.</span> {5}</h3>\n",
      kind, anchor, row, badge(verdict), number, clipped(about, text_limit));
}

std::string card_of(const Book& book, const Place& place) {
  return card(book, {place.owner, place.finding, place.verdict, false});
}

/// Findings behind the first one: a line each.
std::string further(const std::vector<Place>& places) {
  std::string rows;
  for (const auto& place : places) {
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", badge(place.verdict),
                        clipped(place.finding->requirement, 100), clipped(place.owner->name(), text_limit),
                        clipped(headline(*place.finding), text_limit));
  }
  return table("Further findings", "findings", {{"verdict"}, {"requirement"}, {"case"}, {"what came"}}, rows);
}

std::string one_new(const Compared& page, const result::NewCause& one, std::size_t number) {
  const auto& first = one.fresh.front();
  std::string out = article_begin(css_class(one.verdict), difference_kind::worse,
                                  fmt::format("new-{}", number), one.verdict, number, one.cause.about);
  out += fmt::format("<p class=\"headline\">{}</p>\n", clipped(headline(*first.finding), 600));
  if (one.has_spread()) {
    out += fmt::format("<p class=\"quiet\">The old run has this cause as well: {} of {} are new.</p>\n",
                       one.fresh.size(), counted(one.cause.findings.size(), "finding"));
  } else {
    out += fmt::format("<p class=\"quiet\">{}</p>\n", text(extent(one.cause)));
  }
  out += card_of(page.after, first);
  if (one.fresh.size() > 1) {
    const std::vector<Place> rest(one.fresh.begin() + 1, one.fresh.end());
    out += folded(fmt::format("{} more of this cause", counted(rest.size(), "finding")), further(rest));
  }
  return out + "</article>\n";
}

std::string one_gone(const Compared& page, const result::GoneCause& one, std::size_t number) {
  std::string out = article_begin("pass", difference_kind::better, fmt::format("gone-{}", number),
                                  one.cause.verdict, number, one.cause.about);
  const auto& finding = *one.cause.primary.finding;
  out += fmt::format("<p>{} <span class=\"headline\">{}</span></p>\n", clipped(finding.requirement, 100),
                     clipped(headline(finding), 600));
  if (one.left > 0)
    out += fmt::format("<p class=\"quiet\">Only in part: {} gone, {} there still or not judged again.</p>\n",
                       counted(one.mended, "finding"), one.left);
  // Nobody reads how it was before he asks.
  out += folded(fmt::format("How the old run saw it<span class=\"sr\">: {}</span>",
                            clipped(one.cause.about, text_limit)),
                card_of(page.before, one.cause.primary));
  return out + "</article>\n";
}

}  // namespace

std::string new_section(const Compared& page) {
  std::string out;
  std::size_t number = 0;
  for (const auto& one : page.comparison.new_causes) out += one_new(page, one, ++number);
  return section("new", "New causes", out, {"new cause", "new causes"});
}

std::string gone_section(const Compared& page) {
  std::string out;
  std::size_t number = 0;
  for (const auto& one : page.comparison.gone_causes) out += one_gone(page, one, ++number);
  return section("gone", "Gone causes", out, {"gone cause", "gone causes"});
}

}  // namespace conform::reports::html
