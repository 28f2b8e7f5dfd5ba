// SPDX-License-Identifier: Apache-2.0
#include "reports/html/document.hpp"

#include <fmt/format.h>

#include "reports/html/assets.hpp"
#include "reports/html/bar.hpp"
#include "reports/html/markup.hpp"

namespace conform::reports::html {
namespace {

/// Nothing is fetched, sent or framed; of all that is inline the style and the script of ours alone are
/// obeyed.
std::string policy() {
  return fmt::format(
      "default-src 'none'; style-src 'sha256-{}'; script-src 'sha256-{}'; base-uri 'none'; form-action 'none'",
      style_hash, script_hash);
}

std::string head(const Document& page) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<meta name=\"color-scheme\" content=\"light dark\"/>\n<meta name=\"referrer\" content=\"no-referrer\"/>\n"
      "<meta name=\"generator\" content=\"{}\"/>\n<title>{}</title>\n<style>{}</style>\n</head>\n",
      policy(), page.generator, page.title, style_text);
}

/// Shown by the script alone: without it there is nothing to filter with.
std::string filter_bar(const Filter& filter) {
  std::string boxes;
  for (const auto& choice : filter.choices) {
    boxes += fmt::format(
        "<label><input type=\"checkbox\" name=\"v\" value=\"{}\"/>{}<span class=\"n\">{}</span></label>\n",
        choice.value, badge(choice.kind, choice.words), choice.count);
  }
  return fmt::format(
      "<form id=\"filter\" role=\"search\" aria-label=\"Filter of {0}\" hidden=\"hidden\">\n"
      "<label class=\"search\" for=\"q\"><span class=\"sr\">Search in {0}</span>"
      "<input id=\"q\" type=\"search\" placeholder=\"Search: {1} ...   ( / )\" autocomplete=\"off\"/></label>\n"
      "<fieldset><legend class=\"sr\">Show only these {2}</legend>\n{3}</fieldset>\n"
      "<button type=\"reset\">Clear</button>\n<output id=\"shown\" for=\"q\" aria-live=\"polite\"></output>\n</form>\n",
      filter.of, filter.hint, filter.boxes, boxes);
}

std::string navigation(const std::vector<Part>& parts) {
  std::string items;
  for (const auto& part : parts) {
    if (!part.content.empty()) items += fmt::format("<li>{}</li>\n", link(part.id, part.words));
  }
  return fmt::format("<nav aria-label=\"Sections\"><ul>\n{}</ul></nav>\n", items);
}

}  // namespace

std::string document(const Document& page) {
  std::string out = head(page);
  const auto first = page.parts.empty() ? std::string_view() : page.parts.front().id;
  out += fmt::format("<body>\n<a class=\"skip\" href=\"#{}\">Skip to the summary</a>\n{}", first,
                     bar_patterns());
  out += fmt::format("<header>\n<p class=\"brand\">{}</p>\n{}", page.brand, navigation(page.parts));
  out += "<button id=\"theme\" type=\"button\" hidden=\"hidden\">Dark</button>\n" + filter_bar(page.filter) +
         "</header>\n<main>\n";
  for (const auto& part : page.parts) out += part.content;
  out += fmt::format("</main>\n<footer><p>{}</p></footer>\n", page.footer);
  return out + fmt::format("<script>{}</script>\n</body>\n</html>\n", script_text);
}

std::string section(std::string_view id, std::string_view title, const std::string& content, Nouns rows) {
  if (content.empty()) return {};
  const auto nouns = rows.one.empty() ? std::string()
                                      : fmt::format(" data-row=\"{}\" data-rows=\"{}\"", rows.one, rows.many);
  return fmt::format(
      "<section id=\"{0}\" aria-labelledby=\"{0}-title\"{2}>\n<h2 id=\"{0}-title\">{1}</h2>\n{3}</section>\n",
      id, title, nouns, content);
}

}  // namespace conform::reports::html
