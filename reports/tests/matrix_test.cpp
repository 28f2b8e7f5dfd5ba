// SPDX-License-Identifier: Apache-2.0
#include "reports/matrix.hpp"

#include "catch.hpp"
#include "fixture.hpp"
#include "page.hpp"
#include "reports/html/html.hpp"
#include "reports/junit.hpp"

using namespace conform;
using namespace conform::reports;
using result::RunResult;
using result::Verdict;
using testing::contains;
using testing::parsed;
using testing::text_of;

namespace {

/// A device that fails nothing of the sample.
RunResult right_run() {
  auto out = testing::sample_run();
  for (auto& each : out.cases) {
    each.verdict = Verdict::pass;
    for (auto& judgement : each.judgements) judgement.verdict = Verdict::pass;
  }
  out.aborted.reset();
  return out;
}

}  // namespace

TEST_CASE("each device has a column, and each requirement a row with its verdict there") {
  const auto wrong = testing::sample_run(), right = right_run();
  const Matrix matrix({{"drive A", &wrong}, {"drive B", &right}});
  REQUIRE_FALSE(matrix.rows().empty());
  bool failed = false;
  for (const auto& row : matrix.rows()) {
    REQUIRE(row.verdicts.size() == 2);
    failed =
        failed || (row.verdicts[0] == Verdict::fail && row.verdicts[1] == Verdict::pass && row.differs());
  }
  CHECK(failed);
  CHECK(matrix.exit_code() == 1);
  CHECK(matrix.counts(1).fail == 0);
  CHECK(contains(matrix_csv(matrix), "requirement,level,clause,area,drive A,drive B\r\n"));
  CHECK(contains(matrix_markdown(matrix), "**fail** | pass |"));
  CHECK(contains(matrix_text(matrix, {}), "Requirements that not every device meets"));
  CHECK(contains(matrix_html(matrix), "drive B"));
}

TEST_CASE("devices of which one was not judged to the end are not all right") {
  auto right = right_run(), stopped = right_run();
  stopped.aborted = "the bus went away";
  CHECK(Matrix({{"a", &right}, {"b", &right}}).exit_code() == 0);
  const Matrix matrix({{"a", &right}, {"b", &stopped}});
  CHECK(matrix.exit_code() == 3);
  CHECK(contains(matrix_text(matrix, {}), "ended early: the bus went away"));
  CHECK(contains(matrix_html(matrix), "ended early: the bus went away"));
  CHECK(contains(matrix_markdown(matrix), "ended early"));
}

TEST_CASE("what hostile devices call themselves stays text in every form of the matrix") {
  const auto run = testing::hostile_run(testing::hostile_text());
  const Matrix matrix({{testing::hostile_text(), &run}, {"=cmd|calc", &run}});
  const auto text =
      matrix_text(matrix, {}) + matrix_csv(matrix) + matrix_markdown(matrix) + matrix_html(matrix);
  CHECK(std::ranges::none_of(
      text, [](char c) { return (c >= 0 && c < 0x20 && c != '\n' && c != '\r') || c == 0x7F; }));
  CHECK_FALSE(contains(matrix_html(matrix), "<script>alert"));
  CHECK(contains(matrix_csv(matrix), "'=cmd|calc"));
}

TEST_CASE("a device leads to its report, and what it does not meet to the requirement there") {
  const auto wrong = testing::sample_run(), right = right_run();
  const auto page = matrix_html(
      Matrix({{"drive A", &wrong, "../a/report.html"}, {"drive B", &right, "b.html"}, {"drive C", &wrong}}));
  const auto document = parsed(page);
  CHECK(contains(page, "<th scope=\"row\"><a href=\"../a/report.html\">drive A</a></th>"));
  CHECK(contains(page, "<th scope=\"row\">drive C</th>"));
  CHECK(contains(page, "What is not met leads to it in the report of the device."));
  CHECK_FALSE(contains(matrix_html(Matrix({{"drive C", &wrong}})), "leads to it"));
  const auto own = html_report(wrong);
  std::size_t failed = 0;
  for (const auto& found : document.select_nodes("//section[@id='requirements']//td//a")) {
    const std::string target = found.node().attribute("href").value();
    INFO(target);
    const auto front = std::string_view("../a/report.html#");
    REQUIRE(target.starts_with(front));
    CHECK(contains(own, "id=\"" + target.substr(front.size()) + "\""));
    failed += contains(text_of(found.node()), "fail");
  }
  CHECK(failed == Matrix({{"drive A", &wrong}}).counts(0).fail);
}

TEST_CASE("the place of a report stays the target of a link, whatever folders and files are called") {
  const auto wrong = testing::sample_run();
  const auto page = matrix_html(Matrix({{"drive", &wrong, "\"><script>alert(1)</script>/a#b?c%d e&.html"},
                                        {"other", &wrong, "javascript:alert(1)"}}));
  (void)parsed(page);
  CHECK_FALSE(contains(page, "<script>alert"));
  CHECK_FALSE(contains(page, "javascript:"));
  CHECK(contains(page, "%22%3E%3Cscript%3Ealert%281%29%3C/script%3E/a%23b%3Fc%25d%20e%26.html#r-"));
}

TEST_CASE("a page is the report of one run only") {
  const auto run = testing::sample_run();
  const auto page = html_report(run);
  CHECK(is_html_report_of(page, run));
  CHECK(is_html_report_of(
      html_report(run, {.path = "/out/report.html", .reports = {{"json", "/out/r.json"}}}), run));
  CHECK_FALSE(is_html_report_of("", run));
  CHECK_FALSE(is_html_report_of(page.substr(0, page.size() / 2), run));
  CHECK_FALSE(is_html_report_of(page, right_run()));
  auto later = run, other = run, newer = run;
  later.started_utc_ns += 1'000'000'000;
  other.device = "another drive";
  newer.tool += ".1";
  for (const auto& each : {later, other, newer}) CHECK_FALSE(is_html_report_of(page, each));
  const auto hostile = testing::hostile_run(testing::hostile_text());
  CHECK(is_html_report_of(html_report(hostile), hostile));
  CHECK_FALSE(is_html_report_of(matrix_html(Matrix({{"drive", &run}})), run));
}

TEST_CASE("several devices share one JUnit file in which their classes stay apart") {
  const auto wrong = testing::sample_run(), right = right_run();
  const std::vector<JUnitDevice> devices{{&wrong, {"a", ""}}, {&right, {"b", ""}}};
  const auto xml = junit_of_several(devices);
  CHECK(contains(xml, "<testsuites name=\"2 devices\""));
  CHECK(contains(xml, "classname=\"a."));
  CHECK(contains(xml, "classname=\"b."));
}
