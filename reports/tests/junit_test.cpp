// SPDX-License-Identifier: Apache-2.0
// What CI systems rely on; the shape as a whole is checked by the schema (check_junit.py) and the samples.
#include "reports/junit.hpp"

#include <algorithm>
#include <set>
#include <string>

#include <pugixml.hpp>

#include "base/text.hpp"
#include "catch.hpp"
#include "fixture.hpp"
#include "reports/console.hpp"

using namespace conform;
using namespace conform::reports;
using result::RunResult;
using result::Verdict;

namespace {

struct Document {
  explicit Document(const RunResult& run, const JUnitOptions& options = {}) : text(junit(run, options)) {
    REQUIRE(xml.load_string(text.c_str(), pugi::parse_full).status == pugi::status_ok);
  }
  [[nodiscard]] pugi::xml_node root() const { return xml.child("testsuites"); }
  [[nodiscard]] pugi::xml_node find(const std::string& name_start) const {
    for (const pugi::xml_node suite : root().children("testsuite")) {
      for (const pugi::xml_node one : suite.children("testcase")) {
        if (std::string(one.attribute("name").value()).starts_with(name_start)) return one;
      }
    }
    return {};
  }
  std::string text;
  pugi::xml_document xml;
};

RunResult one_case(Verdict verdict) {
  RunResult run = testing::sample_run();
  run.cases.resize(1);
  run.cases.front().verdict = verdict;
  run.cases.front().reason = "because";
  return run;
}

}  // namespace

TEST_CASE("A passing case is an element without content") {
  const Document document(testing::sample_run());
  const pugi::xml_node node = document.find("readable");
  REQUIRE(node);
  CHECK(node.first_child().empty());
  CHECK(std::string(node.attribute("classname").value()) == "cia301.dictionary.1000-device-type");
  CHECK(std::string(node.attribute("time").value()) == "0.002");
}

TEST_CASE("A case that was tried again says so, whatever its verdict") {
  auto run = one_case(Verdict::pass);
  run.cases.front().tried = "2 times: the host was late";
  CHECK(std::string(Document(run).find("readable").child_value("system-out")) ==
        "tried 2 times: the host was late\n");
  run.cases.front().verdict = Verdict::inconclusive;
  CHECK(std::string(Document(run).find("readable").child_value("error"))
            .find("Tried       2 times: the host") != std::string::npos);
  CHECK(case_line(run.cases.front(), {}).find("tried 2 times: the host was late") != std::string::npos);
}

TEST_CASE("A failing case names rule, clause, graded set, bytes, frames and place") {
  const Document document(testing::sample_run());
  const pugi::xml_node failure = document.find("non-zero-write[02h]").child("failure");
  REQUIRE(failure);
  CHECK(std::string(failure.attribute("type").value()) == "conditional");
  const std::string message = failure.attribute("message").value();
  const std::string text = failure.text().get();
  CHECK(message ==
        "OD-1003-06: download 1003h:00 = 02h -> confirmed, expected abort 0609 0030h (invalid value)");
  CHECK(text.starts_with(message + "\n"));
  for (const char* part :
       {"CiA 301 v4.2.0, 7.5.2.4", "Writing any other value", "abort 0609 0031h (value too high)",
        "60 03 10 00 00 00 00 00", "=> (0000000002.002840) vcan0 583#6003100000000000 <"}) {
    INFO(part);
    CHECK(text.find(part) != std::string::npos);
  }
  CHECK(text.ends_with("\ncia301/dictionary/1003-error-history.yaml:14:19"));
}

TEST_CASE("A warning passes and is told in system-out") {
  const Document document(testing::sample_run());
  const pugi::xml_node node = document.find("field-write");
  CHECK_FALSE(node.child("failure"));
  CHECK_FALSE(node.child("error"));
  CHECK(std::string(node.child("system-out").text().get())
            .starts_with(
                "warning: consequence of OD-1003-06, which failed in cia301/dictionary/1003-error-history/"
                "non-zero-write[02h]: OD-1003-08: "));
}

TEST_CASE("What was not judged is an error with its kind, what does not apply is skipped") {
  const Document document(testing::sample_run());
  CHECK(std::string(document.find("heartbeat-period").child("error").attribute("type").value()) ==
        "inconclusive");
  CHECK(std::string(document.find("order").child("error").attribute("type").value()) == "not-run");
  CHECK(document.find("too-long[1A00h]").child("skipped"));
  const Document broken(one_case(Verdict::error));
  CHECK(std::string(broken.find("readable").child("error").attribute("type").value()) == "environment");
}

TEST_CASE("The type of a failure is the weightiest level that was violated") {
  RunResult run = testing::sample_run();
  run.cases.erase(run.cases.begin());
  run.cases.front().judgements.push_back({"EC-HB-09", Verdict::fail, {}, 1});
  const Document document(run);
  CHECK(std::string(document.find("non-zero-write").child("failure").attribute("type").value()) ==
        "mandatory");
  run.requirements.clear();
  const Document unknown(run);
  CHECK(std::string(unknown.find("non-zero-write").child("failure").attribute("type").value()) ==
        "unclassified");
}

TEST_CASE("The numbers on suites and root agree with the cases") {
  const Document document(testing::sample_run());
  CHECK(document.root().attribute("tests").as_int() == 7);
  CHECK(document.root().attribute("failures").as_int() == 2);
  CHECK(document.root().attribute("errors").as_int() == 2);
  int tests = 0;
  for (const pugi::xml_node suite : document.root().children("testsuite"))
    tests += suite.attribute("tests").as_int();
  CHECK(tests == 7);
}

TEST_CASE("Facts stand on every suite and never on a case") {
  const Document document(testing::sample_run());
  for (const pugi::xml_node suite : document.root().children("testsuite")) {
    CHECK(suite.child("properties").find_child_by_attribute("name", "dut.node_id"));
    for (const pugi::xml_node one : suite.children("testcase")) CHECK_FALSE(one.child("properties"));
  }
}

TEST_CASE("A run that stopped early reports every planned case as not run, with the cause") {
  const Document document(testing::aborted_run());
  const pugi::xml_node error = document.find("segmented").child("error");
  CHECK(std::string(error.attribute("message").value()) ==
        "not run: nothing was ever heard from node 05h on can0");
  CHECK(std::string(document.root().child("testsuite").attribute("timestamp").value()) ==
        "2026-11-21T23:55:01Z");
}

TEST_CASE("A run without cases is an error and not an empty report") {
  RunResult run;
  const Document nothing(run);
  CHECK(nothing.root().attribute("errors").as_int() == 1);
  CHECK(nothing.find("run").child("error"));
  run.aborted = "no such interface: can7";
  const Document aborted(run);
  CHECK(std::string(aborted.find("run").child("error").attribute("message").value()) ==
        "no such interface: can7");
}

TEST_CASE("Cases of the same name are told apart") {
  RunResult run = testing::sample_run();
  run.cases = {run.cases[1], run.cases[1], run.cases[1]};
  for (auto& one : run.cases) one.title = std::string(1000, 'x');
  const Document document(run);
  std::set<std::string> names;
  for (const pugi::xml_node one : document.root().child("testsuite").children("testcase")) {
    const std::string name = one.attribute("name").value();
    CHECK(name.size() <= 200);
    CHECK(names.insert(name).second);
  }
  CHECK(names.size() == 3);
}

TEST_CASE("Two suites whose paths look alike as class names become one suite") {
  RunResult run = testing::sample_run();
  run.cases.resize(2);
  run.cases[0].suite = "a b";
  run.cases[1].suite = "/a_b//";
  const Document document(run);
  CHECK(std::string(document.root().child("testsuite").attribute("name").value()) == "a_b");
  CHECK_FALSE(document.root().child("testsuite").next_sibling("testsuite"));
}

TEST_CASE("Prefixes keep devices apart and paths relative to the repository") {
  const Document document(testing::sample_run(), {"drive-a", "suites/"});
  const pugi::xml_node node = document.find("non-zero-write");
  CHECK(std::string(node.attribute("classname").value()) == "drive-a.cia301.dictionary.1003-error-history");
  CHECK(std::string(node.child("failure").text().get())
            .ends_with("\nsuites/cia301/dictionary/1003-error-history.yaml:14:19"));
  CHECK(std::string(node.parent().attribute("file").value()) ==
        "suites/cia301/dictionary/1003-error-history.yaml");
}

TEST_CASE("Whatever a device sends comes back from the XML as its printable form") {
  const std::string hostile = testing::hostile_text();
  const Document document(testing::hostile_run(hostile));
  const pugi::xml_node properties = document.root().child("testsuite").child("properties");
  CHECK(properties.find_child_by_attribute("name", "dut.1008").attribute("value").value() ==
        printable(hostile));
  // XML 1.0 allows tab and line feed of the control characters; carriage returns and the rest never appear.
  CHECK(std::ranges::none_of(document.text,
                             [](char c) { return (c >= 0 && c < 0x20 && c != '\n') || c == 0x7F; }));
  CHECK(document.text.find("&#") == std::string::npos);
  // The end of a CDATA section is forbidden in text; in attributes it is not.
  CHECK(document.text.find("]]&gt; &lt;b&gt;") != std::string::npos);
}

TEST_CASE("Every single byte survives as valid XML") {
  for (int byte = 0; byte < 256; ++byte) {
    RunResult run = one_case(Verdict::fail);
    run.device = std::string(1, static_cast<char>(byte));
    run.properties = {{"dut.1008", run.device}};
    const Document document(run);
    const pugi::xml_node properties = document.root().child("testsuite").child("properties");
    CHECK(properties.find_child_by_attribute("name", "dut.1008").attribute("value").value() ==
          printable(run.device));
  }
}

TEST_CASE("A device cannot add lines to the text of a failure") {
  RunResult run = testing::sample_run();
  run.cases[1].judgements[0].findings[0].actual = "confirmed\nVerdict     pass";
  const Document document(run);
  const std::string text = document.find("non-zero-write").child("failure").text().get();
  CHECK(text.find("\nVerdict     pass") == std::string::npos);
  CHECK(text.find("confirmed\\x0AVerdict     pass") != std::string::npos);
}

TEST_CASE("Messages and texts are bounded") {
  RunResult run = testing::hostile_run(std::string(300'000, 'x'));
  const Document document(run);
  for (const pugi::xml_node suite : document.root().children("testsuite")) {
    for (const pugi::xml_node one : suite.children("testcase")) {
      for (const pugi::xml_node child : one.children()) {
        CHECK(std::string(child.attribute("message").value()).size() <= 250);
        CHECK(std::string(child.text().get()).size() <= 65536);
      }
    }
  }
}

TEST_CASE("The command line, which names files of the machine, is in no JUnit file") {
  const Document document(testing::sample_run());
  CHECK(document.text.find("run.seed") != std::string::npos);
  CHECK(document.text.find("run.command") == std::string::npos);
  CHECK(document.text.find("my report.html") == std::string::npos);
}
