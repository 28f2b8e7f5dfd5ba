// SPDX-License-Identifier: Apache-2.0
// Positions and rendered messages, compared as complete texts.
#include "yaml/source.hpp"
#include "catch.hpp"
#include "yaml/diagnostic.hpp"

namespace {

using namespace conform::yaml;

TEST_CASE("Lines and columns count code points from 1") {
  const Source source("x.yaml", "a\n\xC3\xA9\xE2\x82\xACz\n");
  CHECK(source.line_count() == 2);
  CHECK(source.line(2) == "\xC3\xA9\xE2\x82\xACz");
  CHECK(source.line(3).empty());
  CHECK(source.position(0) == Position{1, 1});
  CHECK(source.position(1) == Position{1, 2});
  CHECK(source.position(2) == Position{2, 1});
  CHECK(source.position(7) == Position{2, 3});
  CHECK(source.offset({2, 3}) == 7);
  CHECK(source.offset({2, 99}) == 8);
  CHECK(source.position(99) == Position{2, 4});
}

TEST_CASE("A byte order mark is dropped and CR LF is one line end") {
  const Source source("x.yaml", "\xEF\xBB\xBF"
                                "a: 1\r\nb: 2\r\n");
  CHECK(source.text() == "a: 1\nb: 2\n");
  CHECK(source.position(5) == Position{2, 1});
}

TEST_CASE("A diagnostic prints its place, the source line and a caret") {
  const auto source = make_source("suites/x.yaml", "format: 1\n        expect: {abbort: 0609 0030h}\n");
  Diagnostics diagnostics(source);
  diagnostics.error({2, 18}, 6, "unknown outcome 'abbort'", "did you mean 'abort'?");
  CHECK(diagnostics.render() == "suites/x.yaml:2:18: error: unknown outcome 'abbort'; did you mean 'abort'?\n"
                                "    2 |         expect: {abbort: 0609 0030h}\n"
                                "      |                  ^~~~~~\n");
}

TEST_CASE("Diagnostics come sorted by place, and the same one only once") {
  Diagnostics diagnostics(make_source("x", "a\nb\n"));
  diagnostics.warning({2, 1}, 1, "second");
  diagnostics.error({1, 1}, 1, "first");
  diagnostics.error({1, 1}, 1, "first");
  CHECK(diagnostics.error_count() == 1);
  CHECK(diagnostics.render() == "x:1:1: error: first\n    1 | a\n      | ^\n"
                                "x:2:1: warning: second\n    2 | b\n      | ^\n");
}

TEST_CASE("The caret stands under its character behind tabs, multi-byte characters and escapes") {
  Diagnostics diagnostics(make_source("x", "\t\xC3\xA9\x01z: q\n"));
  diagnostics.error({1, 4}, 1, "here");
  CHECK(diagnostics.render() == "x:1:4: error: here\n    1 |     \xC3\xA9\\x01z: q\n      |          ^\n");
}

TEST_CASE("A long line is shown around the caret") {
  const std::string text = std::string(500, 'a') + "b" + std::string(500, 'c');
  Diagnostics diagnostics(make_source("x", text));
  diagnostics.error({1, 501}, 900, "here");
  CHECK(diagnostics.render() == "x:1:501: error: here\n    1 | ..." + std::string(40, 'a') + "b" +
                                    std::string(59, 'c') + "...\n      | " + std::string(43, ' ') + "^" +
                                    std::string(59, '~') + "\n");
}

TEST_CASE("A message cannot carry control characters to the terminal") {
  Diagnostics diagnostics(make_source("a\x1b[2J", "x"));
  diagnostics.error({1, 1}, 1, "unknown key '\x1b[31m'");
  CHECK(diagnostics.render() == "a\\x1B[2J:1:1: error: unknown key '\\x1B[31m'\n    1 | x\n      | ^\n");
}

TEST_CASE("Colours surround the same text") {
  Diagnostics diagnostics(make_source("x", "a"));
  diagnostics.error({1, 1}, 1, "here");
  CHECK(
      diagnostics.render(true) ==
      "\x1b[1mx:1:1:\x1b[0m \x1b[1;31merror:\x1b[0m \x1b[1mhere\x1b[0m\n    1 | a\n      | \x1b[1;31m^\x1b[0m\n");
}

TEST_CASE("Beyond the limit diagnostics are counted only") {
  Diagnostics diagnostics(make_source("x", std::string(300, '\n')));
  for (int line = 1; line <= 300; ++line) diagnostics.error({line, 1}, 1, "here");
  CHECK(diagnostics.sorted().size() == Diagnostics::limit);
  CHECK(diagnostics.error_count() == 300);
  CHECK(diagnostics.render().ends_with("x: 100 more not shown\n"));
}

}  // namespace
