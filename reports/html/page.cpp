// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <fmt/format.h>

#include "reports/html/document.hpp"
#include "reports/html/html.hpp"
#include "reports/html/markup.hpp"
#include "reports/html/sections.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports {
namespace {

using namespace html;

/// Verdicts that the page has; the numbers are those of the cases.
std::vector<Choice> choices_of(const result::RunResult& run) {
  struct Kind {
    std::string_view value, words;
    std::size_t result::Counts::* count;
  };
  constexpr std::array kinds{Kind{"fail", "fail", &result::Counts::fail},
                             Kind{"warn", "warn", &result::Counts::warn},
                             Kind{"waived", "waived", &result::Counts::waived},
                             Kind{"inconclusive", "inconclusive", &result::Counts::inconclusive},
                             Kind{"error", "error", &result::Counts::error},
                             Kind{"pass", "pass", &result::Counts::pass},
                             Kind{"na", "not applicable", &result::Counts::not_applicable}};
  const auto counts = run.counts();
  const auto requirements = sum(tally_by_area(run)).counts;
  std::vector<Choice> out;
  for (const auto& kind : kinds) {
    if (counts.*kind.count + requirements.*kind.count != 0)
      out.push_back({kind.value, kind.value, kind.words, counts.*kind.count});
  }
  return out;
}

}  // namespace

std::string html_report(const result::RunResult& run, const Beside& beside) {
  const Book book(run, beside);
  Document page;
  page.title = fmt::format("{}: conformance to CiA 301",
                           run.device.empty() ? "CANopen" : clipped(prose(run.device), 100));
  page.brand = "CANopen conformance report";
  page.generator = clipped(run.tool, 200);
  page.footer = fmt::format("{}, {}.", page.generator,
                            run.started_utc_ns == 0 ? "in simulation" : utc_timestamp(run.started_utc_ns));
  page.filter = {"causes, requirements, cases and entries", "verdicts", "object, requirement, case",
                 choices_of(run)};
  page.parts = {{"summary", "Summary", summary_section(book)},
                {"coverage", "Coverage", coverage_section(book)},
                {"causes", "Causes", cause_section(book)},
                {"compared", "CiA's tool", compared_section(book)},
                {"measurements", "Measurements", measurement_section(book)},
                {"dictionary", "Dictionary", dictionary_section(book)},
                {"changes", "Changes", change_section(book)},
                {"requirements", "Requirements", requirement_section(book)},
                {"cases", "Cases", case_section(book)}};
  return document(page);
}

}  // namespace conform::reports
