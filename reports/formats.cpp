// SPDX-License-Identifier: Apache-2.0
#include "reports/formats.hpp"

#include <algorithm>
#include <array>

#include "reports/annotations.hpp"
#include "reports/badge.hpp"
#include "reports/console.hpp"
#include "reports/html/html.hpp"
#include "reports/junit.hpp"
#include "reports/markdown.hpp"
#include "reports/requirements_csv.hpp"
#include "reports/result_json.hpp"
#include "reports/tap.hpp"

namespace conform::reports {
namespace {

std::string write_junit(const result::RunResult& run, const Beside& /*beside*/) { return junit(run); }
std::string write_evidence(const result::RunResult& run, const Beside& beside) {
  return markdown_evidence(run, beside);
}
std::string write_text(const result::RunResult& run, const Beside& /*beside*/) {
  return summary(run, Style{});
}
std::string write_json(const result::RunResult& run, const Beside& /*beside*/) { return result_json(run); }

std::string write_csv(const result::RunResult& run, const Beside& /*beside*/) {
  return requirements_csv(run);
}
std::string write_tap(const result::RunResult& run, const Beside& /*beside*/) { return tap(run); }
std::string write_code_quality(const result::RunResult& run, const Beside& /*beside*/) {
  return code_quality(run);
}
std::string write_badge(const result::RunResult& run, const Beside& /*beside*/) { return badge(run); }

// A table and not self-registration: the linker drops registrars from static libraries.
constexpr std::array<Format, 10> table{{
    {"junit", "JUnit XML for CI systems (Jenkins, GitLab, Azure, GitHub actions)", ".xml", write_junit},
    {"html", "report for people in one file: opens from an e-mail, prints, works offline", ".html",
     html_report},
    {"json", "everything that was found, for other programs and for 'report' later", ".json", write_json},
    {"markdown", "at most 60 lines for pull requests and job summaries", ".md", markdown},
    {"markdown-evidence", "the findings with their frames, for a wiki", ".md", write_evidence},
    {"csv", "a row for each requirement, with its verdict and what decided it", ".csv", write_csv},
    {"tap", "Test Anything Protocol, a line for each case", ".tap", write_tap},
    {"code-quality", "GitLab's code quality report: an issue for each cause", ".json", write_code_quality},
    {"badge", "picture for a page: how many of the judged requirements passed", ".svg", write_badge},
    {"text", "the summary of the terminal, without colours", ".txt", write_text},
}};

}  // namespace

std::span<const Format> formats() { return table; }

const Format* find_format(std::string_view name) {
  const auto found = std::ranges::find(table, name, &Format::name);
  return found == table.end() ? nullptr : &*found;
}

std::vector<std::string_view> format_names() {
  std::vector<std::string_view> names;
  for (const Format& format : table) names.push_back(format.name);
  return names;
}

}  // namespace conform::reports
