// SPDX-License-Identifier: Apache-2.0
// Each rule of the lint beside a file that it finds and one that it must not (lint_matrix.txt).
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "base/text.hpp"
#include "catch.hpp"
#include "edited.hpp"
#include "eds/lint.hpp"
#include "eds/read.hpp"

namespace {

using namespace conform;
using namespace conform::eds;

const std::string folder = std::string(CONFORM_SOURCE_DIR) + "/harness/eds/tests/";
const std::map<std::string, std::string, std::less<>> bases = {
    {"eds", "legal-whole.eds"},   {"dcf", "legal-whole.dcf"},
    {"min", "legal-minimal.eds"}, {"fix", "legal-fixed-mapping.eds"},
    {"mod", "legal-modules.eds"}, {"con", "legal-connected-modules.dcf"},
    {"xdd", "legal-xml.xdd"},     {"xds", "legal-xml-structure.xdd"}};

struct Row {
  std::string code, base, found, passed;
};

std::string content(const std::string& path) {
  const auto text = read_file(path, 1U << 20U);
  REQUIRE(text.has_value());
  return *text;
}

std::vector<Row> rows() {
  std::vector<Row> out;
  const auto text = content(folder + "lint_matrix.txt");
  for (const auto line : split(text, '\n')) {
    if (trim(line).empty() || line.starts_with('#')) continue;
    const auto parts = split(line, '|');
    INFO(line);
    REQUIRE(parts.size() == 3);
    // Blanks at the end of an edit may be meant: one of each side belongs to the bar.
    const auto inner = [](std::string_view part) { return std::string(part.substr(1)); };
    auto found = inner(parts[1]);
    found.pop_back();
    const auto head = trim(parts[0]);
    out.push_back({std::string(head.substr(0, 6)), std::string(head.substr(7)), found, inner(parts[2])});
  }
  return out;
}

LintReport report_of(const std::string& text, const std::string& name) {
  const auto file = read(text, name);
  REQUIRE(file);
  return lint(*file);
}

std::set<std::string> codes(const LintReport& report, Severity from) {
  std::set<std::string> out;
  for (const auto& finding : report.findings) {
    if (finding.rule->severity >= from) out.emplace(finding.rule->code);
  }
  return out;
}

std::string joined(const std::set<std::string>& words) {
  std::string out;
  for (const auto& word : words) out += word + " ";
  return out;
}

TEST_CASE("Each rule finds the file that is made for it, and not the one beside it") {
  for (const auto& row : rows()) {
    CAPTURE(row.code, row.base, row.found, row.passed);
    const auto& name = bases.at(row.base);
    const auto text = content(folder + "fixtures/" + name);
    const auto found = codes(report_of(edited(text, row.found), name), Severity::note);
    INFO("found: " << joined(found));
    CHECK(found.contains(row.code));
    const auto passed = report_of(edited(text, row.passed), name);
    const auto all = codes(passed, Severity::note);
    INFO("passed: " << joined(all));
    CHECK_FALSE(all.contains(row.code));
    // What stands beside a mistake is right itself.
    CHECK(codes(passed, Severity::error).empty());
  }
}

TEST_CASE("No rule is without its pair, and no pair without its rule") {
  std::set<std::string> paired;
  for (const auto& row : rows()) {
    CAPTURE(row.code);
    CHECK(find_rule(row.code) != nullptr);
    CHECK(row.found != row.passed);
    paired.insert(row.code);
  }
  for (const auto& group : rule_groups()) {
    for (const auto* rule : group.rules) {
      CAPTURE(rule->code);
      CHECK(paired.contains(std::string(rule->code)));
    }
  }
}

}  // namespace
