// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <set>

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

std::string title_of(const result::RunResult& run) {
  return fmt::format("{}: conformance to CiA 301",
                     run.device.empty() ? "CANopen" : clipped(prose(run.device), 100));
}

std::string footer_of(const result::RunResult& run) {
  return fmt::format("{}, {}.", clipped(run.tool, 200),
                     run.started_utc_ns == 0 ? "in simulation" : utc_timestamp(run.started_utc_ns));
}

/// The list entries of a page, by how they begin.
std::set<std::string_view> entries_of(std::string_view page) {
  constexpr std::string_view begin = "<li id=\"";
  std::set<std::string_view> out;
  for (auto at = page.find(begin); at != std::string_view::npos; at = page.find(begin, at + begin.size())) {
    const auto end = page.find('>', at);
    if (end == std::string_view::npos) break;
    out.insert(page.substr(at, end + 1 - at));
  }
  return out;
}

}  // namespace

bool is_html_report_of(std::string_view page, const result::RunResult& run) {
  const auto has = [page](const std::string& part) { return page.find(part) != std::string_view::npos; };
  if (!has(fmt::format("<title>{}</title>", title_of(run))) ||
      !has(fmt::format("<footer><p>{}</p></footer>", footer_of(run))))
    return false;
  const Book book(run);
  const auto entries = entries_of(page);
  return std::ranges::all_of(book.requirements(), [&](const RequirementVerdict& one) {
    return entries.contains(requirement_tag(book, one));
  });
}

std::string html_report(const result::RunResult& run, const Beside& beside) {
  const Book book(run, beside);
  Document page;
  page.title = title_of(run);
  page.brand = "CANopen conformance report";
  page.generator = clipped(run.tool, 200);
  page.footer = footer_of(run);
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
