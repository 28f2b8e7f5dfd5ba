// SPDX-License-Identifier: Apache-2.0
#include "reports/badge.hpp"

#include <fmt/format.h>

#include "reports/tally.hpp"

namespace conform::reports {
namespace {

// Verdana of 11 px, which the badges of others use, is some 7 px wide on average.
constexpr std::size_t letter = 7, margin = 10;

struct Words {
  std::string text;
  std::string_view colour;
};

Words words_of(const result::RunResult& run) {
  const auto counts = sum(tally_by_area(run)).counts;
  const auto open = counts.inconclusive + counts.error;
  const auto right = counts.pass + counts.warn;
  const auto judged = right + counts.waived + counts.fail;
  if (judged == 0) return {"not judged", "#6e7781"};
  std::string text = fmt::format("{}/{}", right, judged);
  if (counts.waived > 0) text += fmt::format(" +{} waived", counts.waived);
  if (open > 0) text += fmt::format(", {} open", open);
  const int code = result::exit_code(run);
  return {std::move(text), code == 0 ? "#1a7f37" : code == 1 ? "#cf222e" : "#9a6700"};
}

}  // namespace

std::string badge(const result::RunResult& run) {
  constexpr std::string_view label = "CiA 301";
  const auto [text, colour] = words_of(run);
  const auto left = label.size() * letter + margin, right = text.size() * letter + margin;
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="20" role="img" aria-label="{4}: {5}">
<title>{4}: {5}</title>
<rect width="{1}" height="20" fill="#424a53"/><rect x="{1}" width="{2}" height="20" fill="{3}"/>
<g fill="#fff" text-anchor="middle" font-family="Verdana,DejaVu Sans,sans-serif" font-size="11">
<text x="{6}" y="14">{4}</text><text x="{7}" y="14">{5}</text>
</g>
</svg>
)",
      left + right, left, right, colour, label, text, left / 2, left + right / 2);
}

}  // namespace conform::reports
