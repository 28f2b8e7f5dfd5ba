// SPDX-License-Identifier: Apache-2.0
#include "eds/lint_roots.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "catch.hpp"
#include "eds/read.hpp"

namespace {

using namespace conform::eds;

/// Consequence -> root, as "EDS257 in line 9" -> "EDS230".
std::map<std::string, std::string> roots_of(const std::string& text) {
  const auto file = read(text, "a.eds");
  REQUIRE(file);
  const auto report = lint(*file);
  const Roots roots(report);
  std::map<std::string, std::string> out;
  for (const auto& finding : report.findings) {
    CHECK(finding.number != 0);
    if (const auto* root = roots.of(finding))
      out.emplace(std::string(finding.rule->code) + " in line " + std::to_string(finding.at.line),
                  root->rule->code);
  }
  return out;
}

TEST_CASE("A wrong data type is the root of what follows from it, in its entry only") {
  const auto found = roots_of(
      "[1003]\nObjectType=8\nSubNumber=2\n[1003sub0]\nDataType=7\nAccessType=rw\n"
      "[1003sub1]\nDataType=7\nAccessType=ro\n[2000]\nObjectType=8\nSubNumber=1\n[2000sub0]\nDataType=7\n");
  CHECK(found.contains("EDS257 in line 5"));
  CHECK(found.at("EDS257 in line 5") == "EDS230");
  CHECK_FALSE(found.contains("EDS257 in line 14"));
}

TEST_CASE("Objects are in no list because the list is not there") {
  const auto found = roots_of("[1000]\nDataType=7\n[1017]\nDataType=6\n[2000]\nDataType=7\n");
  CHECK(found.at("EDS155 in line 1") == "EDS150");
  CHECK(found.at("EDS155 in line 3") == "EDS151");
  CHECK(found.at("EDS155 in line 5") == "EDS151");
  CHECK(roots_of("[OptionalObjects]\nSupportedObjects=0\n[1017]\nDataType=6\n").empty());
}

TEST_CASE("What is mapped and not described is what a list names without a section") {
  const auto found = roots_of(
      "[OptionalObjects]\nSupportedObjects=2\n1=0x1A00\n2=0x6041\n"
      "[1A00]\nObjectType=9\nSubNumber=2\n[1A00sub0]\nDataType=5\nDefaultValue=2\n"
      "[1A00sub1]\nDataType=7\nDefaultValue=0x60410010\n[1A00sub2]\nDataType=7\nDefaultValue=0x60640020\n");
  CHECK(found.at("EDS331 in line 13") == "EDS154");
  CHECK_FALSE(found.contains("EDS331 in line 16"));
}

TEST_CASE("A root that is a consequence itself leads to the last one") {
  const auto found =
      roots_of("[2000]\nDataType=5\nAccessType=rw\nDefaultValue=20\nLowLimit=0\nHighLimit=-1\n");
  CHECK(found.contains("EDS155 in line 1"));
  for (const auto& [consequence, root] : found) {
    CAPTURE(consequence);
    CHECK(root == (consequence.starts_with("EDS155") ? "EDS151" : "EDS071"));
  }
}

TEST_CASE("A root that a policy took away leaves findings of their own") {
  const auto file =
      read("[1003]\nObjectType=8\nSubNumber=1\n[1003sub0]\nDataType=7\nAccessType=rw\n", "a.eds");
  auto report = lint(*file);
  std::erase_if(report.findings, [](const auto& finding) { return finding.rule->code == "EDS230"; });
  const Roots roots(report);
  const auto type =
      std::ranges::find(report.findings, "EDS257", [](const auto& finding) { return finding.rule->code; });
  REQUIRE(type != report.findings.end());
  CHECK(type->because != 0);
  CHECK(roots.of(*type) == nullptr);
}

}  // namespace
