// SPDX-License-Identifier: Apache-2.0
#include "reports/matrix.hpp"

#include "catch.hpp"
#include "fixture.hpp"
#include "reports/junit.hpp"

using namespace conform;
using namespace conform::reports;
using result::RunResult;
using result::Verdict;

namespace {

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

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

TEST_CASE("several devices share one JUnit file in which their classes stay apart") {
  const auto wrong = testing::sample_run(), right = right_run();
  const std::vector<JUnitDevice> devices{{&wrong, {"a", ""}}, {&right, {"b", ""}}};
  const auto xml = junit_of_several(devices);
  CHECK(contains(xml, "<testsuites name=\"2 devices\""));
  CHECK(contains(xml, "classname=\"a."));
  CHECK(contains(xml, "classname=\"b."));
}
