// SPDX-License-Identifier: Apache-2.0
// The samples are what a reader of this repository sees of the reports, and what reviews of a change look at.
// CONFORM_UPDATE_SAMPLES=1 writes them anew.
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "catch.hpp"
#include "comparison.hpp"
#include "fixture.hpp"
#include "reports/compare.hpp"
#include "reports/console.hpp"
#include "reports/formats.hpp"

using namespace conform;
using namespace conform::reports;

namespace {

void compare_with_sample(const std::string& name, const std::string& text) {
  const std::string path = std::string(CONFORM_SOURCE_DIR) + "/reports/samples/" + name;
  if (std::getenv("CONFORM_UPDATE_SAMPLES") != nullptr) {
    std::ofstream(path, std::ios::binary) << text;
    return;
  }
  std::ifstream file(path, std::ios::binary);
  INFO(path);
  REQUIRE(file.is_open());
  std::ostringstream content;
  content << file.rdbuf();
  CHECK(text == content.str());
}

std::string lines_of(const result::RunResult& run, const Style& style) {
  std::string text;
  for (const auto& one : run.cases) text += case_line(one, style) + "\n";
  return text + "\n" + summary(run, style);
}

}  // namespace

TEST_CASE("Every format writes its sample") {
  const Beside beside{"/ci/out/report", {{"html", "/ci/out/report.html"}, {"junit", "/elsewhere/junit.xml"}}};
  for (const Format& format : formats()) {
    const std::string name(format.name);
    const std::string end = format.suffix == "." + name ? name : name + std::string(format.suffix);
    compare_with_sample("run." + end, format.write(testing::sample_run(), beside));
    compare_with_sample("hostile." + end,
                        format.write(testing::hostile_run(testing::hostile_text()), beside));
    compare_with_sample("aborted." + end, format.write(testing::aborted_run(), beside));
  }
}

TEST_CASE("The terminal shows its sample") {
  compare_with_sample("terminal.txt", lines_of(testing::sample_run(), {}));
  compare_with_sample("terminal-80.txt", lines_of(testing::sample_run(), {false, 80, 0}));
  compare_with_sample("terminal-colour.ansi", lines_of(testing::sample_run(), {true, 100, 0}));
}

TEST_CASE("A comparison writes its samples in every format") {
  for (const auto& [name, text] : {std::pair("comparison", std::string("motor 2")),
                                   std::pair("comparison-hostile", testing::hostile_text())}) {
    const auto pair = testing::sample_pair(text);
    const auto comparison = result::compare(pair.before, pair.after);
    const CompareOptions options{false, "old.json", "new.json"};
    const std::string front(name);
    compare_with_sample(front + ".html", compare_html(comparison, options));
    compare_with_sample(front + ".json", compare_json(comparison, options));
    compare_with_sample(front + ".md", compare_markdown(comparison, options));
    compare_with_sample(front + ".txt", compare_text(comparison, options, {}));
  }
}

TEST_CASE("Formats are found by their names") {
  for (const Format& format : formats()) CHECK(find_format(format.name) == &format);
  CHECK(find_format("junit5") == nullptr);
  CHECK(format_names().front() == "junit");
}
