// SPDX-License-Identifier: Apache-2.0
// The object dictionary as a table: described, found, differing.
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/html/sections.hpp"
#include "reports/text_tools.hpp"
#include "result/entries.hpp"

namespace conform::reports::html {
namespace {

using result::EntryDifference;
using result::EntryFacts;
using result::JudgedEntry;
using Judged = std::map<Multiplexer, JudgedEntry>;

constexpr std::size_t few_rows = 30;  ///< a table that need not be folded

/// Parts of the dictionary as CiA 301, 7.4.1 divides it.
struct Range {
  std::uint16_t last;
  std::string_view title;
};
constexpr std::array parts{
    Range{0x0FFF, "Data types and reserved (0000h to 0FFFh)"},
    Range{0x1FFF, "Communication profile (1000h to 1FFFh)"}, Range{0x5FFF, "Manufacturer (2000h to 5FFFh)"},
    Range{0x9FFF, "Device profile (6000h to 9FFFh)"}, Range{0xFFFF, "Beyond (A000h to FFFFh)"}};

std::size_t part_of(Multiplexer object) {
  return static_cast<std::size_t>(
      std::ranges::find_if(parts, [&](const Range& each) { return object.index.value() <= each.last; }) -
      parts.begin());
}

std::string code_of(std::string_view value) {
  constexpr std::size_t width = 80;
  return fmt::format("<code>{}</code>", clipped(value, width));
}

/// What is said of it: type, access, range, default, and who says so.
std::string described(const EntryFacts& entry) {
  if (entry.type.empty()) return "<span class=\"quiet\">not described</span>";
  std::string out =
      fmt::format("{}, {}{}", text(entry.type), text(entry.access), entry.mappable ? ", mappable" : "");
  if (!entry.low.empty() || !entry.high.empty())
    out += fmt::format("<br/>{} to {}", entry.low.empty() ? "any" : code_of(entry.low),
                       entry.high.empty() ? "any" : code_of(entry.high));
  if (!entry.default_value.empty()) out += "<br/>default " + code_of(entry.default_value);
  return out + fmt::format("<br/><span class=\"quiet\">{}</span>", clipped(entry.said_by, 120));
}

std::string found(const EntryFacts& entry) {
  if (entry.presence == result::absent)
    return fmt::format("absent<br/><span class=\"quiet\">{}</span>", clipped(prose(entry.refusal), 120));
  if (entry.presence != result::present || !entry.refusal.empty())
    return fmt::format("{}<br/><span class=\"quiet\">{}</span>",
                       entry.presence == result::present ? "not readable" : text(entry.presence),
                       clipped(prose(entry.refusal), 120));
  std::string out = code_of(entry.value);
  if (entry.size) out += fmt::format("<br/><span class=\"quiet\">{}</span>", counted(*entry.size, "byte"));
  if (!entry.default_value.empty() && entry.default_value != entry.value)
    out += "<br/><span class=\"quiet\">not the default</span>";
  return out;
}

std::string differing(const Book& book, const JudgedEntry& judged) {
  std::string out;
  for (const EntryDifference& each : judged.differing) {
    out += fmt::format("<li>{} {}", badge(each.verdict), each.aspect);
    if (!each.requirement.empty()) out += ", " + book.requirement_link(each.requirement);
    if (!each.came.empty()) out += ": " + clipped(prose(each.came), 160);
    if (each.where != nullptr)
      out += fmt::format(" <span class=\"quiet\">in {}</span>", book.case_link(*each.where));
    out += "</li>\n";
  }
  return out.empty() ? out : "<ul class=\"list\">\n" + out + "</ul>\n";
}

std::string cases_of(const Book& book, const JudgedEntry& judged) {
  if (judged.cases.empty()) return {};
  const auto& first = *judged.cases.front();
  return link(book.anchor(first),
              fmt::format("{}<span class=\"sr\"> about {}, the first</span>",
                          counted(judged.cases.size(), "case"), clipped(first.instance, 40)));
}

std::string_view kind_of(const JudgedEntry& judged) {
  if (judged.differing.empty()) return judged.cases.empty() ? "na" : "pass";
  return css_class(std::ranges::max_element(judged.differing, {}, &EntryDifference::verdict)->verdict);
}

std::string row(const Book& book, const EntryFacts& entry, const Judged& judged) {
  static const JudgedEntry none;
  const auto at = judged.find(entry.object);
  const JudgedEntry& what = at == judged.end() ? none : at->second;
  return fmt::format(
      "<tr data-v=\"{}\"><th scope=\"row\"><b>{}</b><br/>{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
      kind_of(what), to_string(entry.object), clipped(prose(entry.name), 80), described(entry), found(entry),
      differing(book, what), cases_of(book, what));
}

std::string table(std::string_view title, const std::string& rows) {
  return fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{}\"><table class=\"entries\"><thead><tr>"
      "<th scope=\"col\">entry</th><th scope=\"col\">described</th><th scope=\"col\">found at the start</th>"
      "<th scope=\"col\">differing</th><th scope=\"col\">judged by</th></tr></thead><tbody>\n{}</tbody></table></div>\n",
      title, rows);
}

/// Those of the survey, and what findings tell of that nobody described.
std::vector<EntryFacts> all_entries(const result::RunResult& run, const Judged& judged) {
  auto out = run.dictionary;
  std::set<Multiplexer> known;
  for (const auto& entry : out) known.insert(entry.object);
  for (const auto& [object, what] : judged) {
    if (known.contains(object) || what.differing.empty()) continue;
    EntryFacts entry;
    entry.object = object;
    out.push_back(std::move(entry));
  }
  std::ranges::sort(out, {}, &EntryFacts::object);
  return out;
}

std::string part(std::string_view title, std::size_t count, std::size_t wrong, const std::string& rows) {
  const auto words =
      fmt::format("{}, {} differing", count == 1 ? "1 entry" : fmt::format("{} entries", count),
                  wrong == 0 ? std::string("none") : fmt::format("{}", wrong));
  const auto shown = table(title, rows);
  return fmt::format(
      "<div class=\"group whole\">\n<h3>{}</h3>\n{}</div>\n", title,
      count <= few_rows ? fmt::format("<p class=\"quiet\">{}</p>\n{}", words, shown) : folded(words, shown));
}

}  // namespace

std::string dictionary_section(const Book& book) {
  const auto judged = result::judged_entries(book.run());
  if (book.run().dictionary.empty()) return {};
  std::array<std::string, parts.size()> rows;
  std::array<std::size_t, parts.size()> counts{}, wrong{};
  std::string differing_rows;
  std::size_t differing_count = 0;
  for (const auto& entry : all_entries(book.run(), judged)) {
    const auto at = part_of(entry.object);
    const auto what = judged.find(entry.object);
    const bool differs = what != judged.end() && !what->second.differing.empty();
    const auto written = row(book, entry, judged);
    rows[at] += written;
    ++counts[at];
    if (!differs) continue;
    ++wrong[at];
    ++differing_count;
    differing_rows += written;
  }
  std::string out;
  // What one looks for first; the whole table may be long.
  if (differing_count > 0)
    out += fmt::format("<div class=\"group differs\" data-again=\"\">\n<h3>Differing: {}</h3>\n{}</div>\n",
                       differing_count == 1 ? "1 entry" : fmt::format("{} entries", differing_count),
                       table("Differing entries", differing_rows));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (counts[i] > 0) out += part(parts[i].title, counts[i], wrong[i], rows[i]);
  }
  return section("dictionary", "Object dictionary", out, {"entry", "entries"});
}

}  // namespace conform::reports::html
