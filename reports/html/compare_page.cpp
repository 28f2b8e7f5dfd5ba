// SPDX-License-Identifier: Apache-2.0
// Two runs side by side, on one page.
#include <algorithm>

#include <fmt/format.h>

#include "reports/compare.hpp"
#include "reports/html/compare_sections.hpp"
#include "reports/html/document.hpp"
#include "reports/html/markup.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports {
namespace {

using namespace html;

/// Boxes for what the page has rows of.
std::vector<Choice> choices_of(const result::Comparison& comparison) {
  const std::size_t different = comparison.gained.size() + comparison.observed.size() +
                                comparison.instances.size() + comparison.entries.size() +
                                comparison.times.size();
  const std::vector<Choice> all{
      {difference_kind::worse, "fail", "worse", comparison.new_causes.size() + comparison.worse.size()},
      {difference_kind::better, "pass", "better", comparison.gone_causes.size() + comparison.better.size()},
      {difference_kind::lost, "inconclusive", "no longer judged", comparison.lost.size()},
      {difference_kind::other, "na", "different", different}};
  std::vector<Choice> out;
  std::ranges::copy_if(all, std::back_inserter(out), [](const Choice& each) { return each.count > 0; });
  return out;
}

std::string title_of(const result::Comparison& comparison) {
  const auto name = [](const result::RunResult& run) {
    return run.device.empty() ? std::string("a device") : clipped(prose(run.device), 60);
  };
  const auto before = name(*comparison.before), after = name(*comparison.after);
  return before == after ? after : fmt::format("{} and {}", before, after);
}

}  // namespace

std::string compare_html(const result::Comparison& comparison, const CompareOptions& options) {
  const Compared compared(comparison, options);
  Document page;
  page.title = fmt::format("{}: {}", title_of(comparison), outcome_of(comparison, options.strict).head);
  page.brand = "CANopen conformance, compared";
  page.generator = clipped(comparison.after->tool, 200);
  page.footer =
      fmt::format("Old: {}. New: {}.", clipped(options.old_name, 200), clipped(options.new_name, 200));
  page.filter = {"differences", "kinds of difference", "object, requirement, case", choices_of(comparison)};
  page.parts = {{"summary", "Summary", compared_summary(compared)},
                {"new", "New", new_section(compared)},
                {"gone", "Gone", gone_section(compared)},
                {"turned", "Requirements", turn_section(compared)},
                {"answers", "Answers", answer_section(compared)},
                {"dictionary", "Dictionary", dictionary_section(compared)},
                {"times", "Times", times_section(compared)},
                {"left-out", "Not compared", left_out_section(compared)}};
  return document(page);
}

}  // namespace conform::reports
