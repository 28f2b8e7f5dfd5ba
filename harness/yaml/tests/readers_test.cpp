// SPDX-License-Identifier: Apache-2.0
// Two parsers read, and nobody can tell which.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "catch.hpp"
#include "yaml/careful_reader.hpp"
#include "yaml/loader.hpp"
#include "yaml/quick_reader.hpp"
#include "yaml/tests/dump.hpp"

namespace {

using namespace conform::yaml;
namespace fs = std::filesystem;

/// What both readers make of a text: "nothing" from the quick one where it leaves the text to the other.
struct Both {
  explicit Both(std::string_view text) {
    const auto source = make_source("x.yaml", text);
    Diagnostics scratch(source);
    Diagnostics diagnostics(source);
    if (const auto root = read_quickly(*source, scratch)) quick = dump(*root);
    if (const auto root = read_carefully(*source, diagnostics)) careful = dump(*root);
    messages = diagnostics.render();
  }
  std::string quick = "nothing", careful = "nothing", messages;
};

TEST_CASE("Every file of the suites is read quickly, to the same tree with the same places") {
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(CONFORM_SOURCE_DIR "/suites")) {
    if (entry.path().extension() != ".yaml") continue;
    CAPTURE(entry.path().string());
    const auto source = read_source(entry.path().string());
    REQUIRE(source);
    const Both both((*source)->text());
    CHECK(both.quick == both.careful);
    CHECK(both.messages.empty());
    ++files;
  }
  CHECK(files > 150);
}

TEST_CASE("What is written in every way YAML has becomes the same tree") {
  for (const auto* text : {
           "a: [1, 2,\n  3]\nb: {c: d,\n  e: 'it''s', f: \"\\x41\\n\\u00e9\"}\n",
           "- - x\n  - y\n-\n  z: 1\n-\n- # nothing\n",
           "text: >\n  one\n  two\n\n  three\nlines: |-\n  a\n   b\n\n  c\nkept: |+\n  x\n\nend: 1\n",
           "plain text\n  over lines: x\n",
           "a: plain\n  over\n\n  lines\nb: \"quoted\n  over\n  lines\"\n",
           "\xC3\xA9: \xE2\x82\xAC  # \xF0\x9F\x98\x80\nb: [\xC3\xBC, x]\nc: |\n  \xC3\xA4\n",
           "---\na: 1\n...\n",
           "a: {}\nb: []\nc: ''\nd:\n",
           "? a\n: b\n",
           "a:   # comment\n  b: c#d  # e\n'f' : \"g\"\n",
           "[a, {b: c}, [d]]",
           "a:\n  - # nothing\n  -\n",
           "{a: [b, c], 'd': e}",
           "a: -1\nb: 1..240\nc: $x + 1\nd: 80h+$node\n",
       }) {
    CAPTURE(text);
    const Both both(text);
    if (both.messages.empty()) CHECK(both.quick == both.careful);
    if (both.quick != "nothing") CHECK(both.messages.empty());
  }
}

TEST_CASE("What there is anything to say of is left to the careful reader") {
  for (const auto* text :
       {"a: &x 1\nb: *x\n", "a: !t 1\n", "a: 1\na: 2\n", "a: yes\n", "a: ~\n", "<<: {a: 1}\n", "[a, b",
        "a: 'b\n", "a: 1\n---\nb: 2\n", "a: b: c\n", "[1]: 2\n", "\ta: 1\n", "", "# nothing\n", "&a [1]\n",
        "!!map {a: 1}\n", "a: 010\n", "a: @b\n"}) {
    CAPTURE(text);
    const Both both(text);
    CHECK(both.quick == "nothing");
    CHECK_FALSE(both.messages.empty());
  }
}

}  // namespace
