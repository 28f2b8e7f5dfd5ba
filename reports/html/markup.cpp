// SPDX-License-Identifier: Apache-2.0
#include "reports/html/markup.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports::html {

using result::Verdict;

namespace {

std::string escaped(std::string_view printable_text) {
  std::string out;
  out.reserve(printable_text.size());
  for (const char c : printable_text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      default: out += c;
    }
  }
  return out;
}

}  // namespace

std::string text(std::string_view any) { return escaped(printable(any)); }

std::string sentence(std::string_view any) { return escaped(prose(any)); }

std::string clipped(std::string_view any, std::size_t width) { return escaped(clip(printable(any), width)); }

std::string code(std::string_view any) { return fmt::format("<code>{}</code>", text(any)); }

std::string_view css_class(Verdict verdict) {
  return verdict == Verdict::not_applicable ? "na" : result::to_string(verdict);
}

std::string badge(Verdict verdict) { return badge(css_class(verdict), verdict_words(verdict)); }

std::string badge(std::string_view kind, std::string_view words) {
  return fmt::format("<span class=\"b {}\">{}</span>", kind, text(words));
}

std::string link(std::string_view target, std::string_view content) {
  return fmt::format("<a href=\"#{}\">{}</a>", target, content);
}

std::string folded(std::string_view summary, std::string_view content) {
  return fmt::format("<details><summary>{}</summary>\n{}</details>\n", summary, content);
}

std::string row_lists(std::string_view kind, const std::vector<std::string>& rows) {
  constexpr std::size_t size = 40;
  constexpr std::size_t few = 10;
  std::string out;
  for (std::size_t from = 0; from < rows.size(); from += size) {
    const std::size_t to = std::min(from + size, rows.size());
    // The class lets the style guess the height before it is known.
    out += fmt::format("<ul class=\"rows {}{}\">\n", kind, to - from <= few ? " few" : "");
    for (std::size_t i = from; i < to; ++i) out += rows[i];
    out += "</ul>\n";
  }
  return out;
}

std::string fact(std::string_view label, std::string_view value) {
  if (value.empty()) return {};
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", label, value);
}

std::string table(std::string_view label, std::string_view kind, const std::vector<Column>& columns,
                  std::string_view rows) {
  std::string head;
  for (const auto& column : columns)
    head +=
        fmt::format("<th scope=\"col\"{}>{}</th>", column.is_number ? " class=\"num\"" : "", column.words);
  return fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{}\"><table class=\"{}\"><thead><tr>{}</tr></thead>"
      "<tbody>\n{}</tbody></table></div>\n",
      label, kind, head, rows);
}

std::string number_cell(std::size_t number) {
  return fmt::format("<td class=\"num{}\">{}</td>", number == 0 ? " zero" : "", number);
}

std::string coordinate(double value) {
  const double rounded = std::round(value * 10) / 10;
  return fmt::format("{:g}", rounded == 0 ? 0.0 : rounded);
}

}  // namespace conform::reports::html
