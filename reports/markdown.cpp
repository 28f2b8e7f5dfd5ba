// SPDX-License-Identifier: Apache-2.0
#include "reports/markdown.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/markdown_parts.hpp"
#include "reports/markdown_text.hpp"
#include "reports/tally.hpp"
#include "reports/text_tools.hpp"
#include "result/cause_captures.hpp"

namespace conform::reports {
namespace {

using result::RunResult;

// What the parts may take of the 60 lines, with their headings and the lines between.
constexpr std::size_t most_causes = 15, most_areas = 6, most_waivers = 3, most_wants = 3, most_notes = 3;

std::string cell(std::size_t number) { return number == 0 ? std::string() : fmt::format("{}", number); }

/// Areas in which something did not pass, and the sum of all: at most 11 lines.
std::string areas_text(const RunResult& run) {
  const auto rows = tally_by_area(run);
  if (rows.empty()) return {};
  std::string text =
      "\n| Requirements | pass | waived | warn | fail | not judged | n/a |\n|---|--:|--:|--:|--:|--:|--:|\n";
  const auto add = [&text](std::string_view name, const result::Counts& counts) {
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", name, cell(counts.pass),
                        cell(counts.waived), cell(counts.warn), cell(counts.fail),
                        cell(counts.inconclusive + counts.error), cell(counts.not_applicable));
  };
  std::vector<const AreaTally*> bad;
  for (const auto& row : rows) {
    const auto& counts = row.counts;
    if (counts.fail + counts.warn + counts.waived + counts.inconclusive + counts.error > 0)
      bad.push_back(&row);
  }
  std::ranges::stable_sort(bad, std::ranges::greater{},
                           [](const AreaTally* row) { return row->counts.fail; });
  bad.resize(std::min(bad.size(), most_areas));
  for (const auto* row : bad) add(escaped(row->area, 100), row->counts);
  AreaTally others;
  for (const auto& row : rows) {
    if (std::ranges::find(bad, &row) == bad.end()) others.counts += row.counts;
  }
  if (!bad.empty() && bad.size() < rows.size())
    add(counted(rows.size() - bad.size(), "other area"), others.counts);
  add("**total**", sum(rows).counts);
  return text;
}

/// What CiA's own tool would say, in one line.
std::string compared_text(const RunResult& run) {
  if (run.compared.empty()) return {};
  std::vector<std::pair<std::string, std::size_t>> outcomes;
  for (const auto& each : run.compared) {
    const auto found = std::ranges::find(outcomes, each.outcome, &std::pair<std::string, std::size_t>::first);
    if (found == outcomes.end()) {
      outcomes.emplace_back(each.outcome, 1);
    } else {
      ++found->second;
    }
  }
  std::vector<std::string> parts;
  for (const auto& [outcome, number] : outcomes)
    parts.push_back(fmt::format("{} {}", number, escaped(outcome)));
  return fmt::format("\nWhat CiA's tool would say of its {}: {}.\n", counted(run.compared.size(), "case"),
                     join(parts, ", "));
}

/// What one could give, and what was noted.
std::string wants_text(const RunResult& run) {
  std::vector<std::string> wants, notes;
  for (const auto& each : tally_wants(run))
    wants.push_back(fmt::format("{}: {}", counted(each.cases, "case"), escaped(each.want.text)));
  for (const auto& note : run.notes) notes.push_back(escaped(note));
  return markdown_list("\n### To have more judged\n\n", wants, most_wants) +
         markdown_list("\n### Notes\n\n", notes, most_notes);
}

/// "[html](report.html)": a link where the file lies in a folder near this one, else its path.
std::string rest_text(const Beside& beside) {
  std::vector<std::string> parts;
  auto files = beside.reports;
  if (!beside.captures.empty()) files.emplace("one capture per cause", beside.captures);
  for (const auto& [name, path] : files) {
    if (path == beside.path) continue;
    const auto relative = beside.relative(path);
    const bool links = relative != path && !relative.starts_with("../..");
    parts.push_back(links ? fmt::format("[{}]({})", escaped(name), link_target(relative))
                          : fmt::format("{} {}", escaped(name), code(path)));
  }
  if (parts.empty())
    return "\nThe frames behind each finding are in the other reports: \\-\\-html, \\-\\-junit, \\-\\-markdown-evidence.\n";
  return fmt::format("\nThe rest, with the frames behind each finding: {}.\n", join(parts, ", "));
}

}  // namespace

std::string markdown(const RunResult& run, const Beside& beside) {
  std::string text = markdown_head(run);
  const auto causes = result::causes_of(run);
  text += markdown_causes(run, causes, most_causes);
  text += areas_text(run);
  text += markdown_waivers(run, most_waivers);
  text += compared_text(run);
  text += wants_text(run);
  return text + rest_text(beside);
}

}  // namespace conform::reports
