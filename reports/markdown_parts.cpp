// SPDX-License-Identifier: Apache-2.0
#include "reports/markdown_parts.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/text.hpp"
#include "reports/cause_lines.hpp"
#include "reports/markdown_text.hpp"
#include "reports/phrases.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports {

using result::Cause;
using result::Counts;
using result::RunResult;
using result::Verdict;

namespace {

std::string banner(const RunResult& run, int exit_code) {
  switch (exit_code) {
    case 0:
      if (const auto waived = run.waived(); !waived.empty())
        return fmt::format("conforms but for {}, waived: {}", counted(waived.size(), "violated requirement"),
                           escaped(join(waived, ", ")));
      return "conforms";
    case 1: return "does not conform";
    case 2: return "nothing was judged";
    default: return "not fully judged";
  }
}

}  // namespace

std::string counts_text(const Counts& counts) {
  struct Part {
    Verdict verdict;
    std::size_t number;
  };
  const std::array<Part, 7> parts{{{Verdict::fail, counts.fail},
                                   {Verdict::error, counts.error},
                                   {Verdict::inconclusive, counts.inconclusive},
                                   {Verdict::warn, counts.warn},
                                   {Verdict::waived, counts.waived},
                                   {Verdict::pass, counts.pass},
                                   {Verdict::not_applicable, counts.not_applicable}}};
  std::string text;
  for (const Part& part : parts) {
    if (part.number == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", part.number, verdict_words(part.verdict));
  }
  return text.empty() ? "none" : text;
}

std::string markdown_head(const RunResult& run) {
  const int exit_code = result::exit_code(run);
  std::string text = fmt::format("## {}: {}\n\n{}, {}: {}. Exit code {}.\n",
                                 escaped(run.device.empty() ? "CANopen conformance" : run.device, 100),
                                 banner(run, exit_code), escaped(run.tool), counted(run.cases.size(), "case"),
                                 counts_text(run.counts()), exit_code);
  if (run.aborted) text += fmt::format("\nStopped early: {}\n", escaped(*run.aborted));
  return text;
}

std::string markdown_causes(const RunResult& run, const std::vector<Cause>& causes, std::size_t most) {
  if (causes.empty()) return {};
  std::string text = "\n| | Cause | Requirement | Cases | First case |\n|---|---|---|--:|---|\n";
  for (std::size_t i = 0; i < std::min(causes.size(), most); ++i) {
    const Cause& cause = causes[i];
    auto known = likeness_words(run, cause);
    if (!known.empty()) known = "; " + escaped(known, 120);
    text += fmt::format("| {} | {}: {}{} | {} | {} | {} |\n", verdict_words(cause.verdict),
                        escaped(cause.about), escaped(headline(*cause.primary.finding), 160), known,
                        escaped(cause.primary.finding->requirement),
                        cause.cases.size() + cause.resting.size(), code(cause.primary.owner->name()));
  }
  if (causes.size() > most)
    text += fmt::format("\n... and {}\n", counted(causes.size() - most, "more cause"));
  return text;
}

std::string markdown_list(std::string_view heading, const std::vector<std::string>& items, std::size_t most) {
  if (items.empty()) return {};
  std::string text(heading);
  for (std::size_t i = 0; i < std::min(items.size(), most); ++i) text += fmt::format("- {}\n", items[i]);
  if (items.size() > most) text += fmt::format("- and {} more\n", items.size() - most);
  return text;
}

std::string markdown_waivers(const RunResult& run, std::size_t most) {
  std::vector<std::string> items;
  for (const auto& each : run.waivers) items.push_back(escaped(waiver_text(each)));
  return markdown_list("\n### Waivers\n", items, most);
}

}  // namespace conform::reports
