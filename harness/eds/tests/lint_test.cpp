// SPDX-License-Identifier: Apache-2.0
// Every fixture has exactly the findings that it announces. That each rule has its file is the matter of
// lint_matrix_test.cpp.
#include "eds/lint.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "catch.hpp"
#include "eds/read.hpp"

namespace {

namespace fs = std::filesystem;
using namespace conform;
using namespace conform::eds;
using Codes = std::set<std::string>;

const fs::path folder = fs::path(CONFORM_SOURCE_DIR) / "harness/eds/tests/fixtures";

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The codes behind "expects:" in a comment of the file.
Codes expected(std::string_view text) {
  constexpr std::string_view word = "expects: ";
  const auto begin = text.find(word);
  REQUIRE(begin != std::string_view::npos);
  const auto line = text.substr(begin + word.size(), text.find_first_of("\r\n", begin) - begin - word.size());
  Codes out;
  for (const auto each : split(line, ' ')) {
    if (each.starts_with("EDS")) out.emplace(each);
  }
  return out;
}

Codes codes(const LintReport& report) {
  Codes out;
  for (const auto& finding : report.findings) out.emplace(finding.rule->code);
  return out;
}

std::vector<fs::path> fixtures() {
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(folder)) out.push_back(entry.path());
  std::ranges::sort(out);
  return out;
}

TEST_CASE("Every fixture has exactly the findings that it announces, and a legal one has none") {
  for (const auto& path : fixtures()) {
    CAPTURE(path.filename().string());
    const auto text = content(path);
    const auto file = eds::read(text, path.filename().string());
    REQUIRE(file);
    const auto report = lint(*file);
    const auto wanted = expected(text);
    CHECK(codes(report) == wanted);
    CHECK(wanted.empty() == path.filename().string().starts_with("legal-"));
    CHECK(report.left_out == 0);
    for (const auto& finding : report.findings) {
      CHECK(finding.at.known());
      CHECK(finding.at.line <=
            static_cast<std::uint32_t>(
                std::ranges::count_if(text, [](char c) { return c == '\n' || c == '\r'; }) + 1));
      CHECK_FALSE(finding.message.empty());
      CHECK_FALSE(finding.message.ends_with('.'));
    }
  }
}

TEST_CASE("Codes are unique, ascending and well-formed") {
  std::string last;
  for (const auto& group : rule_groups()) {
    CHECK_FALSE(group.rules.empty());
    for (const auto* rule : group.rules) {
      CAPTURE(rule->code);
      CHECK(rule->code.size() == 6);
      CHECK(rule->code.starts_with("EDS"));
      CHECK(last < rule->code);
      CHECK_FALSE(rule->title.empty());
      CHECK_FALSE(rule->title.ends_with('.'));
      CHECK_FALSE(rule->source.empty());
      CHECK(find_rule(rule->code) == rule);
      last = std::string(rule->code);
    }
  }
  CHECK(find_rule("EDS999") == nullptr);
}

TEST_CASE("A finding points at the very text") {
  const auto path = folder / "bad-value-range.eds";
  const auto text = content(path);
  const auto report = lint(*eds::read(text, "bad-value-range.eds"));
  REQUIRE(report.findings.size() == 1);
  const auto& finding = report.findings[0];
  CHECK(finding.message == "[2000] DefaultValue: 300 is no value of UNSIGNED8");
  const auto lines = split(text, '\n');
  const auto line = lines[finding.at.line - 1];
  CHECK(line.substr(finding.at.column - 1) == "300");
}

TEST_CASE("A misspelled key is told with the one that was meant") {
  const auto report = lint(*eds::read("[1000]\nAcessType=ro\n", "a.eds"));
  const auto found =
      std::ranges::find(report.findings, "EDS020", [](const auto& finding) { return finding.rule->code; });
  REQUIRE(found != report.findings.end());
  CHECK(found->hint == "did you mean AccessType?");
}

TEST_CASE("A finding stays short however long the text is that it is about") {
  const std::string text =
      "[2000" + std::string(5000, ' ') +
      "Value]\n[2001]\nDataType=5\nCompactSubObj=200\nParameterName=" + std::string(1'000'000, 'x') +
      "\nAccessType=wo ;" + std::string(5000, 'y') + "\n[1001]\nAccessType=rw;" + std::string(5000, 'z') +
      "\n";
  const auto report = lint(*eds::read(text, "a.eds"));
  CHECK(report.findings.size() > 5);
  for (const auto& finding : report.findings) CHECK(finding.message.size() < 300);
  CHECK(codes(report).contains("EDS276"));
}

TEST_CASE("Findings are in the order of the file") {
  std::string text = content(folder / "bad-junk-line.eds") + content(folder / "bad-hash-comment.eds");
  const auto report = lint(*eds::read(text, "a.eds"));
  CHECK(report.findings.size() > 10);
  CHECK(std::ranges::is_sorted(report.findings, {}, &Finding::at));
}

TEST_CASE("A file that repeats one mistake without end is reported in part, and says so") {
  std::string text = "[DeviceInfo]\n";
  for (int i = 0; i < 5000; ++i)
    text += "Dummy" + std::to_string(i) + "=x\nBaudRate_" + std::to_string(i) + "=x\n";
  const auto report = lint(*eds::read(text, "a.eds"));
  CHECK(report.left_out > 0);
  CHECK(report.findings.size() < 4 * most_of_a_rule);
}

TEST_CASE("The page of the codes is the one that the program writes") {
  CHECK(content(fs::path(CONFORM_SOURCE_DIR) / "docs/eds-lint.md") == lint_table_markdown());
}

TEST_CASE("Every message of CANchkEDS has a code that exists, or a reason") {
  const auto page = content(fs::path(CONFORM_SOURCE_DIR) / "docs/eds-canchkeds.md");
  std::size_t errors = 0, warnings = 0;
  for (const auto line : split(page, '\n')) {
    const bool error = line.starts_with("| error ");
    if (!error && !line.starts_with("| warning ")) continue;
    CAPTURE(line);
    ++(error ? errors : warnings);
    bool some = line.find("| none: ") != std::string_view::npos;
    for (auto at = line.find("EDS"); at != std::string_view::npos; at = line.find("EDS", at + 1)) {
      if (at + 3 >= line.size() || line[at + 3] < '0' || line[at + 3] > '9') continue;  // EDSVersion
      CHECK(find_rule(line.substr(at, 6)) != nullptr);
      some = true;
    }
    CHECK(some);
  }
  CHECK(errors == 59);
  CHECK(warnings == 15);
}

}  // namespace
