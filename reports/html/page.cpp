// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <fmt/format.h>

#include "reports/html/assets.hpp"
#include "reports/html/bar.hpp"
#include "reports/html/html.hpp"
#include "reports/html/markup.hpp"
#include "reports/html/sections.hpp"
#include "reports/text_tools.hpp"

namespace conform::reports {
namespace {

using namespace html;

/// Nothing is fetched, sent or framed; of all that is inline the style and the script of ours alone are
/// obeyed.
std::string policy() {
  return fmt::format(
      "default-src 'none'; style-src 'sha256-{}'; script-src 'sha256-{}'; base-uri 'none'; form-action 'none'",
      style_hash, script_hash);
}

std::string head(const result::RunResult& run) {
  const std::string device = run.device.empty() ? "CANopen" : clipped(prose(run.device), 100);
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<meta name=\"color-scheme\" content=\"light dark\"/>\n<meta name=\"referrer\" content=\"no-referrer\"/>\n"
      "<meta name=\"generator\" content=\"{}\"/>\n<title>{}: conformance to CiA 301</title>\n<style>{}</style>\n</head>\n",
      policy(), clipped(run.tool, 200), device, style_text);
}

/// Shown by the script alone: without it there is nothing to filter with.
std::string filter_bar(const result::RunResult& run) {
  struct Choice {
    std::string_view kind, words;
    std::size_t result::Counts::* count;
  };
  constexpr std::array choices{Choice{"fail", "fail", &result::Counts::fail},
                               Choice{"warn", "warn", &result::Counts::warn},
                               Choice{"waived", "waived", &result::Counts::waived},
                               Choice{"inconclusive", "inconclusive", &result::Counts::inconclusive},
                               Choice{"error", "error", &result::Counts::error},
                               Choice{"pass", "pass", &result::Counts::pass},
                               Choice{"na", "not applicable", &result::Counts::not_applicable}};
  const auto counts = run.counts();
  const auto requirements = sum(tally_by_area(run)).counts;
  std::string boxes;
  for (const auto& choice : choices) {
    if (counts.*choice.count + requirements.*choice.count == 0) continue;
    boxes += fmt::format(
        "<label><input type=\"checkbox\" name=\"v\" value=\"{}\"/>{}<span class=\"n\">{}</span></label>\n",
        choice.kind, badge(choice.kind, choice.words), counts.*choice.count);
  }
  return fmt::format(
      "<form id=\"filter\" role=\"search\" aria-label=\"Filter of requirements, cases and entries\" hidden=\"hidden\">\n"
      "<label class=\"search\" for=\"q\"><span class=\"sr\">Search in causes, requirements, cases and entries</span>"
      "<input id=\"q\" type=\"search\" placeholder=\"Search: object, requirement, case ...   ( / )\" autocomplete=\"off\"/></label>\n"
      "<fieldset><legend class=\"sr\">Show only these verdicts</legend>\n{}</fieldset>\n"
      "<button type=\"reset\">Clear</button>\n<output id=\"shown\" for=\"q\" aria-live=\"polite\"></output>\n</form>\n",
      boxes);
}

std::string navigation(const std::vector<std::pair<std::string_view, std::string_view>>& parts) {
  std::string items;
  for (const auto& [target, words] : parts) items += fmt::format("<li>{}</li>\n", link(target, words));
  return fmt::format("<nav aria-label=\"Sections\"><ul>\n{}</ul></nav>\n", items);
}

}  // namespace

std::string html_report(const result::RunResult& run, const Beside& beside) {
  const Book book(run, beside);
  struct Section {
    std::string_view id, words;
    std::string (*write)(const Book&);
  };
  constexpr std::array sections{Section{"summary", "Summary", summary_section},
                                Section{"coverage", "Coverage", coverage_section},
                                Section{"causes", "Causes", cause_section},
                                Section{"compared", "CiA's tool", compared_section},
                                Section{"measurements", "Measurements", measurement_section},
                                Section{"dictionary", "Dictionary", dictionary_section},
                                Section{"changes", "Changes", change_section},
                                Section{"requirements", "Requirements", requirement_section},
                                Section{"cases", "Cases", case_section}};
  std::string content;
  std::vector<std::pair<std::string_view, std::string_view>> parts;
  for (const Section& section : sections) {
    const std::string written = section.write(book);
    if (written.empty()) continue;
    parts.emplace_back(section.id, section.words);
    content += written;
  }
  std::string out = head(run);
  out += "<body>\n<a class=\"skip\" href=\"#summary\">Skip to the summary</a>\n" + bar_patterns();
  out += "<header>\n<p class=\"brand\">CANopen conformance report</p>\n" + navigation(parts);
  out += "<button id=\"theme\" type=\"button\" hidden=\"hidden\">Dark</button>\n" + filter_bar(run) +
         "</header>\n";
  out += fmt::format("<main>\n{}</main>\n", content);
  out += fmt::format("<footer><p>{}, {}.</p></footer>\n", clipped(run.tool, 200),
                     run.started_utc_ns == 0 ? "in simulation" : utc_timestamp(run.started_utc_ns));
  out += fmt::format("<script>{}</script>\n</body>\n</html>\n", script_text);
  return out;
}

}  // namespace conform::reports
