// SPDX-License-Identifier: Apache-2.0
#include "reports/html/compare_sections.hpp"

#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/html/difference.hpp"
#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/html/plots.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {
namespace {

using result::Turn;
using result::Verdict;

constexpr std::size_t text_limit = 300;
constexpr std::size_t value_limit = 160;
/// Of a value that is longer than what is shown of it; the JSON has the whole.
constexpr std::size_t whole_limit = 4000;

std::string verdict_badge(std::optional<Verdict> verdict) {
  return verdict ? badge(*verdict) : badge("na", "not judged");
}

std::string one_turn(const Compared& page, const Turn& turn, std::string_view kind) {
  const auto* info = page.after.run().requirement(turn.requirement);
  std::string out = fmt::format(
      "<li data-v=\"{}\">\n<p><span class=\"sr\">was </span>{} <span aria-hidden=\"true\">&#x2192;</span> <span class=\"sr\">now "
      "</span>{} <b>{}</b> ",
      kind, verdict_badge(turn.before), verdict_badge(turn.after), clipped(turn.requirement, 200));
  if (info != nullptr) {
    out += clipped(prose(info->statement), 1000);
    out += fmt::format(" <span class=\"quiet\">{}{}{}</span>", sentence(info->clause),
                       info->clause.empty() || info->level.empty() ? "" : ", ", sentence(info->level));
  }
  out += "</p>\n";
  if (turn.where != nullptr)
    out += fmt::format("<p class=\"by\">case {}{}</p>\n", clipped(turn.where->name(), text_limit),
                       turn.where->reason.empty() ? "" : ": " + clipped(prose(turn.where->reason), 600));
  return out + "</li>\n";
}

std::string turns(const Compared& page, std::string_view title, const std::vector<Turn>& all,
                  std::string_view kind) {
  if (all.empty()) return {};
  std::vector<std::string> rows;
  for (const auto& turn : all) rows.push_back(one_turn(page, turn, kind));
  return fmt::format("<div class=\"group\">\n<h3>{} <span class=\"quiet\">{}</span></h3>\n{}</div>\n", title,
                     all.size(), row_lists("turns", rows));
}

/// Old and new, what differs marked; of long values the whole to unfold.
std::string value_cells(const std::string& before, const std::string& after) {
  const auto shown = difference(before, after, value_limit);
  const auto cell = [](const std::string& markup, const std::string& whole) {
    const auto all = printable(whole);
    std::string out = "<td>" + markup;
    if (columns(all) > value_limit)
      out += folded("the whole", "<pre>" + clipped(all, whole_limit) + "</pre>");
    return out + "</td>";
  };
  return cell(shown.before, before) + cell(shown.after, after);
}

std::string observed(const Compared& page) {
  std::string rows;
  for (const auto& each : page.comparison.observed) {
    const auto name = clipped(each.where->name(), text_limit);
    const auto what = each.step.empty()
                          ? name
                          : fmt::format("{}<br/><span class=\"quiet\">{} {}</span>",
                                        clipped(each.step, text_limit), clipped(each.requirement, 100), name);
    rows += fmt::format("<tr data-v=\"{}\"><th scope=\"row\">{}</th>{}</tr>\n", difference_kind::other, what,
                        value_cells(each.before, each.after));
  }
  if (rows.empty()) return {};
  return fmt::format("<div class=\"group\">\n{}</div>\n", table("Steps with another answer", "pairs",
                                                                {{"step, or case"}, {"old"}, {"new"}}, rows));
}

std::string object_list(const std::vector<std::string>& all) {
  constexpr std::size_t most = 40;
  std::string out;
  for (std::size_t i = 0; i < std::min(all.size(), most); ++i)
    out += (i == 0 ? "" : ", ") + clipped(all[i], 100);
  if (all.size() > most) out += fmt::format(" and {} more", all.size() - most);
  return out.empty() ? "<span class=\"quiet\">none</span>" : out;
}

std::string instances(const Compared& page) {
  std::string rows;
  for (const auto& each : page.comparison.instances) {
    rows += fmt::format("<tr data-v=\"{}\"><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n",
                        difference_kind::other, clipped(each.id, text_limit), object_list(each.gone),
                        object_list(each.added));
  }
  if (rows.empty()) return {};
  return fmt::format("<div class=\"group\">\n<h3>Tried for other objects</h3>\n{}</div>\n",
                     table("Scenarios that were tried for other objects", "pairs",
                           {{"scenario"}, {"only for, old"}, {"only for, new"}}, rows));
}

std::string entries_of(const Compared& page, result::Area area) {
  std::string rows;
  for (const auto& each : page.comparison.entries) {
    if (result::area_of(each.object.index) != area) continue;
    const auto remark =
        each.is_process ? fmt::format("<br/><span class=\"quiet\">{}</span>", process_words) : "";
    rows += fmt::format("<tr data-v=\"{}\"><th scope=\"row\">{}{}</th>{}</tr>\n", difference_kind::other,
                        to_string(each.object), remark, value_cells(each.before, each.after));
  }
  if (rows.empty()) return {};
  const auto words = to_string(area);
  std::string title(words);
  title.front() = static_cast<char>(title.front() - 'a' + 'A');
  return fmt::format("<div class=\"group\">\n<h3>{}</h3>\n{}</div>\n", title,
                     table(fmt::format("Entries: {}", words), "pairs", {{"entry"}, {"old"}, {"new"}}, rows));
}

std::string figure(const Compared& page, const result::TimesChange& change) {
  const auto series = series_of(change, page.before.run(), page.after.run());
  const auto title = times_title(change), what = times_words(change), how = certainty_words(change);
  const auto drawing = pair_plot(page.after, clip(prose(title + ": " + what), text_limit), series.before,
                                 series.after, change.is_spread);
  return fmt::format("<figure data-v=\"{}\">\n{}<figcaption><b>{}</b>: {}. {}.</figcaption>\n</figure>\n",
                     difference_kind::other, drawing, clipped(prose(title), text_limit), text(what),
                     text(how));
}

std::string requirements_in_one(std::string_view which, const std::vector<std::string>& all) {
  if (all.empty()) return {};
  std::string items;
  for (const auto& id : all) items += fmt::format("<li>{}</li>\n", clipped(id, 200));
  return folded(fmt::format("{} in the {} run only", counted(all.size(), "requirement"), which),
                fmt::format("<ul class=\"list\">\n{}</ul>\n", items));
}

}  // namespace

std::string turn_section(const Compared& page) {
  const auto& of = page.comparison;
  return section("turned", "Requirements with another verdict",
                 turns(page, "Worse", of.worse, difference_kind::worse) +
                     turns(page, "No longer judged", of.lost, difference_kind::lost) +
                     turns(page, "Better", of.better, difference_kind::better) +
                     turns(page, "Now judged as well", of.gained, difference_kind::other),
                 {"requirement", "requirements"});
}

std::string answer_section(const Compared& page) {
  return section("answers", "Other answers", observed(page) + instances(page), {"answer", "answers"});
}

std::string dictionary_section(const Compared& page) {
  std::string out;
  using result::Area;
  for (const auto area : {Area::communication, Area::manufacturer, Area::profile, Area::other})
    out += entries_of(page, area);
  return section("dictionary", "Dictionary", out, {"entry", "entries"});
}

std::string times_section(const Compared& page) {
  std::string out;
  for (const auto& change : page.comparison.times) out += figure(page, change);
  return section("times", "Times", out, {"time", "times"});
}

std::string left_out_section(const Compared& page) {
  std::string items;
  for (const auto& remark : page.comparison.remarks)
    items += fmt::format("<li>{}</li>\n", clipped(prose(remark), 1000));
  if (!items.empty()) items = fmt::format("<ul class=\"list\">\n{}</ul>\n", items);
  return section("left-out", "Not compared",
                 items + requirements_in_one("old", page.comparison.only_in_old) +
                     requirements_in_one("new", page.comparison.only_in_new));
}

}  // namespace conform::reports::html
