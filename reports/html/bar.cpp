// SPDX-License-Identifier: Apache-2.0
#include "reports/html/bar.hpp"

#include <array>

#include <fmt/format.h>

#include "reports/html/markup.hpp"

namespace conform::reports::html {

using result::Counts;
using result::Verdict;

namespace {

struct Kind {
  Verdict verdict;
  std::size_t Counts::* count;
};
constexpr std::array<Kind, 7> worst_first{{{Verdict::fail, &Counts::fail},
                                           {Verdict::error, &Counts::error},
                                           {Verdict::inconclusive, &Counts::inconclusive},
                                           {Verdict::warn, &Counts::warn},
                                           {Verdict::waived, &Counts::waived},
                                           {Verdict::pass, &Counts::pass},
                                           {Verdict::not_applicable, &Counts::not_applicable}}};

}  // namespace

std::string bar_patterns() {
  return "<svg class=\"patterns\" width=\"0\" height=\"0\" aria-hidden=\"true\" focusable=\"false\"><defs>\n"
         "<pattern id=\"p-warn\" width=\"5\" height=\"5\" patternUnits=\"userSpaceOnUse\" "
         "patternTransform=\"rotate(45)\"><rect class=\"warn\" width=\"5\" height=\"5\"/>"
         "<path class=\"gap\" d=\"M0 0v5\"/></pattern>\n"
         "<pattern id=\"p-unsure\" width=\"5\" height=\"5\" patternUnits=\"userSpaceOnUse\">"
         "<rect class=\"unsure\" width=\"5\" height=\"5\"/><circle class=\"dot\" cx=\"2.5\" cy=\"2.5\" r=\"1.2\"/></pattern>\n"
         "</defs></svg>\n";
}

std::string bar(const Counts& counts) {
  if (counts.total() == 0) return {};
  // Shares of the width and no view box: the patterns are never stretched.
  std::string out = "<svg class=\"bar\" aria-hidden=\"true\" focusable=\"false\">";
  double x = 0;
  for (const Kind& kind : worst_first) {
    const std::size_t number = counts.*kind.count;
    if (number == 0) continue;
    const double part = 100 * static_cast<double>(number) / static_cast<double>(counts.total());
    out += fmt::format("<rect class=\"{}\" x=\"{}%\" width=\"{}%\" height=\"100%\"/>",
                       css_class(kind.verdict), coordinate(x), coordinate(part));
    x += part;
  }
  return out + "</svg>";
}

std::string count_badges(const Counts& counts, std::size_t not_judged) {
  std::string out;
  for (const Kind& kind : worst_first) {
    const std::size_t number = counts.*kind.count;
    if (number != 0) out += fmt::format("<li><b>{}</b> {}</li>\n", number, badge(kind.verdict));
  }
  if (not_judged != 0) out += fmt::format("<li><b>{}</b> {}</li>\n", not_judged, badge("na", "not judged"));
  return out.empty() ? out : fmt::format("<ul class=\"counts\">\n{}</ul>\n", out);
}

}  // namespace conform::reports::html
