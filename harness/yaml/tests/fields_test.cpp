// SPDX-License-Identifier: Apache-2.0
// Typed reads: what they return, and that every mistake of a file is reported at its place.
#include "yaml/fields.hpp"

#include <chrono>

#include "catch.hpp"
#include "yaml/tests/checked.hpp"

namespace {

using namespace conform;
using namespace conform::yaml;
using namespace std::chrono_literals;

enum class Access { ro, rw };

TEST_CASE("Every type reads in the notation of the field") {
  Checked file("title: Error history\n"
               "count: 17\n"
               "hex: 1Fh\n"
               "low: -128\n"
               "wait: 100 ms\n"
               "object: 1003h:01\n"
               "data: 2F 03 10 00\n"
               "flag: true\n"
               "access: rw\n"
               "checks: [A-01, A-02]\n"
               "single: A-03\n"
               "inner: {a: 1}\n");
  REQUIRE(file.messages().empty());
  {
    Fields fields(*file.root, file.diagnostics, "scenario");
    CHECK(fields.required("title").text() == "Error history");
    CHECK(fields.required("count").number(1, 17) == 17);
    CHECK(fields.required("hex").number() == 0x1F);
    CHECK(fields.required("low").integer(-128, 127) == -128);
    CHECK(fields.required("wait").duration() == 100ms);
    CHECK(fields.required("object").multiplexer() == Multiplexer{Index(0x1003), SubIndex(1)});
    CHECK(fields.required("data").bytes() == Bytes{0x2F, 0x03, 0x10, 0x00});
    CHECK(fields.required("flag").boolean() == true);
    CHECK(fields.required("access").one_of<Access>({{"ro", Access::ro}, {"rw", Access::rw}}) == Access::rw);
    const auto text = [](const Field& item) { return item.text(); };
    CHECK(fields.required("checks").list(text) == std::vector<std::string>{"A-01", "A-02"});
    CHECK(fields.required("single").list_or_one(text) == std::vector<std::string>{"A-03"});
    Fields inner = fields.required("inner").fields("inner part");
    CHECK(inner.required("a").number() == 1);
    CHECK_FALSE(fields.optional("absent").text());
    CHECK_FALSE(fields.optional("absent").list(text));
    CHECK_FALSE(fields.optional("absent").fields("x").required("y").number());
  }
  CHECK(file.messages().empty());
}

TEST_CASE("All mistakes of a mapping are reported, at their places") {
  Checked file("titel: x\n"
               "count: 300\n"
               "wait: 100\n"
               "object: 1003\n"
               "data: 2F 0\n"
               "flag: 1\n"
               "access: rv\n"
               "checks: A-01\n"
               "colour: {a: 1}\n");
  REQUIRE(file.messages().empty());
  {
    Fields fields(*file.root, file.diagnostics, "scenario");
    CHECK_FALSE(fields.required("title").text());
    CHECK_FALSE(fields.required("id").text());
    CHECK_FALSE(fields.optional("count").number(1, 127));
    CHECK_FALSE(fields.optional("wait").duration());
    CHECK_FALSE(fields.optional("object").multiplexer());
    CHECK_FALSE(fields.optional("data").bytes());
    CHECK_FALSE(fields.optional("flag").boolean());
    CHECK_FALSE(fields.optional("access").one_of<Access>({{"ro", Access::ro}, {"rw", Access::rw}}));
    CHECK_FALSE(fields.optional("checks").list([](const Field& item) { return item.text(); }));
    CHECK_FALSE(fields.optional("colour").text());
  }
  CHECK(
      file.brief() ==
      "1:1 unknown key 'titel' in the scenario; did you mean 'title'?\n"
      "1:1 the scenario needs a key 'id'\n"
      "2:8 'count' is 300; allowed is 1 to 127\n"
      "3:7 expected a duration for 'wait', found '100'; write a number and a unit: 100 ms, 1.5 s, 250 us, 2 min\n"
      "4:9 expected an object for 'object', found '1003'; write index and sub-index as 1003h:00\n"
      "5:7 expected bytes for 'data', found '2F 0'; write two hex digits for each: 2F 03 10 00\n"
      "6:7 expected true or false for 'flag', found '1'\n"
      "7:9 expected ro or rw for 'access', found 'rv'; did you mean 'ro'?\n"
      "8:9 expected a list for 'checks', found 'A-01'\n"
      "9:9 expected text for 'colour', found a mapping\n");
}

TEST_CASE("The message is complete with line and underline") {
  Checked file("steps:\n  - expect: {abbort: 0609 0030h}\n");
  {
    Fields outcome(*file.root->find("steps")->items().at(0).find("expect"), file.diagnostics, "outcome");
    static_cast<void>(outcome.optional("abort"));
    static_cast<void>(outcome.optional("value"));
  }
  CHECK(file.messages() == "x.yaml:2:14: error: unknown key 'abbort' in the outcome; did you mean 'abort'?\n"
                           "    2 |   - expect: {abbort: 0609 0030h}\n"
                           "      |              ^~~~~~\n");
}

TEST_CASE("A comma inside a flow mapping is explained") {
  Checked file("e: {warn: abort 0609 0031h, abort 0800 0000h}\n");
  {
    Fields outcome(*file.root->find("e"), file.diagnostics, "outcome");
    static_cast<void>(outcome.optional("warn"));
  }
  CHECK(
      file.brief() ==
      "1:29 unknown key 'abort 0800 0000h' in the outcome; a comma ends an entry of { }: write several values as [a, "
      "b], or quote the text\n");
}

TEST_CASE("A missing space behind a colon is explained") {
  Checked other("a: id:x\n");
  {
    const Fields fields(*other.root->find("a"), other.diagnostics, "step");
  }
  CHECK(other.brief() ==
        "1:4 expected a mapping for the step, found 'id:x'; a space is needed behind the colon\n");
}

TEST_CASE("A step is named by exactly one verb") {
  const auto read = [](Checked& file) {
    Fields step(*file.root, file.diagnostics, "step");
    return step.exactly_one_of({"upload", "download", "talk"}).name();
  };
  Checked good("upload: x\n");
  CHECK(read(good) == "'upload'");
  CHECK(good.messages().empty());
  Checked none("{}\n");
  CHECK(read(none).empty());
  CHECK(none.brief() == "1:1 the step needs one of upload, download or talk\n");
  Checked two("talk: x\nupload: z\n");
  CHECK(read(two) == "'upload'");
  CHECK(two.brief() == "1:1 'talk' does not go with 'upload' in one step; give one of them\n");
  Checked misspelt("downlaod: x\n");
  CHECK(read(misspelt).empty());
  CHECK(misspelt.brief() == "1:1 unknown key 'downlaod' in the step; did you mean 'download'?\n");
}

TEST_CASE("What the loader refused is not reported twice") {
  Checked file("a: 010\nb: yes\n");
  REQUIRE(file.diagnostics.error_count() == 2);
  {
    Fields fields(*file.root, file.diagnostics, "step");
    CHECK_FALSE(fields.required("a").number());
    CHECK_FALSE(fields.required("b").boolean());
  }
  CHECK(file.diagnostics.error_count() == 2);
}

TEST_CASE("A boolean is no text, and an empty text is none either") {
  Checked file("a: true\nb: \"\"\nc:\n");
  {
    Fields fields(*file.root, file.diagnostics, "step");
    CHECK_FALSE(fields.required("a").text());
    CHECK_FALSE(fields.required("b").text());
    CHECK_FALSE(fields.required("c").text());
  }
  CHECK(file.brief() ==
        "1:4 expected text for 'a', found 'true'; quote it if it is not meant as a boolean: \"true\"\n"
        "2:4 the text of 'b' is empty\n"
        "3:1 expected text for 'c', found nothing\n");
}

TEST_CASE("A bad item of a list is left out and reported") {
  Checked file("a: [1, x, 300, 2]\n");
  {
    Fields fields(*file.root, file.diagnostics, "step");
    CHECK(fields.required("a").list([](const Field& item) { return item.number(0, 255); }) ==
          std::vector<std::uint64_t>{1, 2});
  }
  CHECK(file.brief() == "1:8 expected a number for an item of 'a', found 'x'; write 17, 11h or 0x11\n"
                        "1:11 an item of 'a' is 300; allowed is 0 to 255\n");
}

TEST_CASE("The extremes of signed integers read exactly") {
  Checked file("a: -9223372036854775808\nb: 9223372036854775807\nc: -9223372036854775809\nd: -0x80\n");
  {
    Fields fields(*file.root, file.diagnostics, "step");
    CHECK(fields.required("a").integer() == std::numeric_limits<std::int64_t>::min());
    CHECK(fields.required("b").integer() == std::numeric_limits<std::int64_t>::max());
    CHECK_FALSE(fields.required("c").integer());
    CHECK(fields.required("d").integer() == -128);
  }
  CHECK(file.diagnostics.error_count() == 1);
}

TEST_CASE("Keys can be allowed without being read") {
  Checked file("a: 1\nb: 2\n");
  {
    Fields fields(*file.root, file.diagnostics, "step");
    fields.known({"a", "b"});
  }
  {
    Fields fields(*file.root, file.diagnostics, "step");
    fields.allow_others();
  }
  CHECK(file.messages().empty());
}

}  // namespace
