// SPDX-License-Identifier: Apache-2.0
#include "eds/lint_policy.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "eds/lint_comments.hpp"
#include "eds/read.hpp"

namespace {

using namespace conform::eds;

LintReport report_of(std::string_view text, const LintPolicy& policy = {}, std::string name = "a.eds") {
  const auto file = read(text, std::move(name));
  REQUIRE(file);
  return apply(policy, lint(*file), text, *file);
}

std::size_t count_of(const LintReport& report, std::string_view code) {
  return static_cast<std::size_t>(std::ranges::count_if(
      report.findings, [code](const Finding& finding) { return finding.rule->code == code; }));
}

/// Two sections of a variable, each without AccessType (EDS204) and with a leading zero (EDS052).
std::string file_with(std::string_view head, std::string_view section, std::string_view line) {
  std::string out(head);
  out += "[FileInfo]\nFileVersion=1\n";
  out += section;
  out += "[2000]\nParameterName=A\nObjectType=7\n";
  out += line;
  out += "DataType=010\n[2001]\nParameterName=B\nObjectType=7\nDataType=010\n";
  return out;
}

TEST_CASE("A comment at the head of the file allows a rule for all of it") {
  REQUIRE(count_of(report_of(file_with("", "", "")), "EDS052") == 2);
  const auto report = report_of(file_with("; lint: allow EDS052 octal is meant\n", "", ""));
  CHECK(count_of(report, "EDS052") == 0);
  CHECK(count_of(report, "EDS204") == 2);
  CHECK(count_of(report, "EDS903") == 0);
  CHECK(report.allowed == 2);
}

TEST_CASE("A comment before a section allows several rules there, one before an entry only in its line") {
  auto report = report_of(file_with("", ";LINT: Allow eds052, EDS204: old tools\n\n", ""));
  CHECK(count_of(report, "EDS052") == 1);
  CHECK(count_of(report, "EDS204") == 1);
  report = report_of(file_with("", "", "; lint: allow EDS052 octal is meant\n"));
  CHECK(count_of(report, "EDS052") == 1);
  CHECK(count_of(report, "EDS204") == 2);
  report = report_of(file_with("", "", "; lint: allow EDS204 not the place for it\n"));
  CHECK(count_of(report, "EDS204") == 2);
  CHECK(count_of(report, "EDS903") == 1);
}

TEST_CASE("A comment before the section of an object allows a rule for its sub-indices as well") {
  const auto text = [](std::string_view comment) {
    return "[FileInfo]\n" + std::string(comment) +
           "[2000]\nObjectType=9\n[2000sub0]\nDataType=010\n[2000sub1]\nDataType=010\n[2001]\nDataType=010\n";
  };
  CHECK(count_of(report_of(text("")), "EDS052") == 3);
  CHECK(count_of(report_of(text("; lint: allow EDS052 octal is meant\n")), "EDS052") == 1);
}

TEST_CASE("A comment without reason, with an unknown rule or an unknown word allows nothing and is told") {
  auto report = report_of(file_with("; lint: allow EDS052\n", "", ""));
  CHECK(count_of(report, "EDS052") == 2);
  CHECK(count_of(report, "EDS902") == 1);
  report = report_of(file_with("; lint: allow EDS998 nobody knows\n", "", ""));
  CHECK(count_of(report, "EDS901") == 1);
  report = report_of(file_with("; lint: ignore EDS052 please\n; lint: allow this\n", "", ""));
  CHECK(count_of(report, "EDS900") == 2);
  CHECK(report.findings.front().at == Position{1, 1});
  report = report_of(file_with("; about lint: nothing for it\n", "", ""));
  CHECK(count_of(report, "EDS900") == 0);
}

TEST_CASE("A comment that allows what is not found is told as a note") {
  const auto report = report_of(file_with("; lint: allow EDS054 some h\n", "", ""));
  CHECK(count_of(report, "EDS903") == 1);
  CHECK(report.allowed == 0);
}

TEST_CASE("A comment in XML allows a rule for the element behind it, before the root for the whole file") {
  const auto text = [](std::string_view head, std::string_view inside) {
    return "<?xml version=\"1.0\"?>\n" + std::string(head) +
           "<ISO15745ProfileContainer><ISO15745Profile><ProfileBody><ApplicationLayers>"
           "<CANopenObjectList>\n" +
           std::string(inside) +
           "<CANopenObject index=\"2000\" name=\"A\" objectType=\"7\" accessType=\"xx\" dataType=\"0007\"/>\n"
           "<CANopenObject index=\"2001\" name=\"B\" objectType=\"7\" accessType=\"xx\" dataType=\"0007\"/>\n"
           "</CANopenObjectList></ApplicationLayers></ProfileBody></ISO15745Profile></ISO15745ProfileContainer>\n";
  };
  const std::string comment = "<!-- lint: allow EDS205 words of our own -->\n";
  CHECK(count_of(report_of(text("", ""), {}, "a.xdd"), "EDS205") == 2);
  CHECK(count_of(report_of(text("", comment), {}, "a.xdd"), "EDS205") == 1);
  const auto whole = report_of(text(comment, ""), {}, "a.xdd");
  CHECK(count_of(whole, "EDS205") == 0);
  CHECK(count_of(whole, "EDS903") == 0);
}

TEST_CASE("A policy switches rules off and gives others another severity") {
  LintPolicy policy;
  policy.off.insert(find_rule("EDS204"));
  policy.severity[find_rule("EDS052")] = Severity::error;
  const auto before = report_of(file_with("", "", ""));
  const auto report = report_of(file_with("", "", ""), policy);
  CHECK(count_of(report, "EDS204") == 0);
  CHECK(report.allowed == 2);
  CHECK(report.count(Severity::warning) + 2 == before.count(Severity::warning));
  CHECK(report.count(Severity::error) == before.count(Severity::error));
}

TEST_CASE("Of a rule that is off nothing is left out either") {
  std::string text = "[FileInfo]\n";
  for (int i = 0; i < 1100; ++i) text += "[" + std::to_string(2000 + i) + "]\nDataType=010\n";
  const auto all = report_of(text);
  REQUIRE(all.left_out_of.at(find_rule("EDS052")) == 100);
  LintPolicy policy;
  policy.off.insert(find_rule("EDS052"));
  const auto report = report_of(text, policy);
  CHECK(report.left_out + 100 == all.left_out);
  CHECK(report.allowed == 1100);
}

TEST_CASE("Comments by the thousand take no time") {
  std::string text;
  for (int i = 0; i < 200'000; ++i) text += ";lint: allow EDS052 x\n";
  CHECK(read_lint_comments(text + "[2000]\nDataType=010\n", {}).allowed.size() == LintComments::most);
}

}  // namespace
