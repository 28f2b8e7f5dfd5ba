// SPDX-License-Identifier: Apache-2.0
// What a good file becomes, and the complete messages about a bad one.
#include <string>

#include "catch.hpp"
#include "yaml/tests/checked.hpp"

namespace {

using namespace conform::yaml;

TEST_CASE("A document becomes a tree with kinds, texts and places") {
  const Checked file("format: 1\n"
                     "cct: [\"2.10\", '8.1']\n"
                     "steps:\n"
                     "  - download: {object: 1003h:00, value: $count}\n"
                     "  - talk:\n");
  REQUIRE(file.messages().empty());
  REQUIRE(file.root);
  const Node& root = *file.root;
  CHECK(root.is_mapping());
  CHECK_FALSE(root.flow());
  REQUIRE(root.entries().size() == 3);
  CHECK(root.find("format")->text() == "1");
  CHECK(root.find("format")->plain());
  CHECK(root.find("nothing") == nullptr);
  const Node& cct = *root.find("cct");
  CHECK(cct.flow());
  CHECK(cct.items().at(0).quoted());
  CHECK(cct.items().at(0).text() == "2.10");
  CHECK(cct.items().at(0).position() == Position{2, 7});
  CHECK(cct.items().at(0).length() == 6);
  CHECK(cct.items().at(1).position_at(2) == Position{2, 18});
  const Node& download = *root.find("steps")->items().at(0).find("download");
  CHECK(download.find("object")->text() == "1003h:00");
  CHECK(download.find("object")->position() == Position{4, 24});
  CHECK(download.find("value")->text() == "$count");
  const Node& talk = *root.find("steps")->items().at(1).find("talk");
  CHECK(talk.is_null());
  CHECK(talk.position() == Position{5, 5});
  CHECK(talk.length() == 4);
}

TEST_CASE("An item without a value stands at its dash, whatever comment follows") {
  const Checked file("- # nothing\n# more\n\n-\n- a\n-   \n");
  REQUIRE(file.root);
  REQUIRE(file.root->items().size() == 4);
  CHECK(file.root->items().at(0).position() == Position{1, 1});
  CHECK(file.root->items().at(1).position() == Position{4, 1});
  CHECK(file.root->items().at(3).position() == Position{6, 1});
}

TEST_CASE("Every line of a literal block knows where it stands") {
  const Checked file("talk: |   # two frames\n"
                     "    > 600+N: 40\n"
                     "\n"
                     "      < 580+N: \xC3\xA9 41\n"
                     "next: x\n");
  REQUIRE(file.messages().empty());
  const Node& talk = *file.root->find("talk");
  CHECK(talk.block_scalar());
  CHECK(talk.text() == "> 600+N: 40\n\n  < 580+N: \xC3\xA9 41\n");
  CHECK(talk.line_position(0) == Position{2, 5});
  CHECK(talk.line_position(1) == Position{3, 1});
  CHECK(talk.line_position(2) == Position{4, 5});
  CHECK(talk.position_at(9) == Position{2, 14});
  CHECK(talk.position_at(talk.text().find("41")) == Position{4, 18});
}

TEST_CASE("A folded block is one text without places of its own") {
  const Checked file("about: >\n  one\n  two\nb: 1\n");
  const Node& about = *file.root->find("about");
  CHECK(about.folded());
  CHECK_FALSE(about.plain());
  CHECK(about.text() == "one two\n");
  CHECK(about.position_at(5) == Position{1, 8});
}

TEST_CASE("The notation of CANopen is plain text") {
  const Checked file(
      "a: [1003h:00, 1018h:01, 0609 0030h, 01h, FEh, 00h, 100 ms, 2F 03 10 00, 1..240, 0x1F, 17, -5, 0, true, false]\n"
      "b: 1016h:*\n"
      "c: count 9..11, period 100 ms +-10 %\n"
      "d: 80h+$node\n"
      "e: 4.2.0\n"
      "f: [\"010\", 'yes', \"~\"]\n");
  CHECK(file.messages().empty());
  CHECK(file.root);
}

TEST_CASE("Words and numbers that YAML readers disagree on are refused with the reason") {
  CHECK(
      Checked("yes: 010\n").messages() ==
      "x.yaml:1:1: error: 'yes' is ambiguous in YAML: some readers take it for a boolean; quote it: \"yes\", or write "
      "true or false\n"
      "    1 | yes: 010\n"
      "      | ^~~\n"
      "x.yaml:1:6: error: '010' is ambiguous in YAML: with its leading zero some readers take it for octal; drop the "
      "zero, write hex as 010h, or quote it: \"010\"\n"
      "    1 | yes: 010\n"
      "      |      ^~~\n");
  CHECK(
      Checked("a: 2.10\n").messages() ==
      "x.yaml:1:4: error: '2.10' is ambiguous in YAML: readers take it for a floating-point number; quote it: "
      "\"2.10\"\n"
      "    1 | a: 2.10\n"
      "      |    ^~~~\n");
  CHECK(
      Checked("a: 12:30\n").messages() ==
      "x.yaml:1:4: error: '12:30' is ambiguous in YAML: some readers take it for a number to base 60; write the index "
      "as hex (1003h:00), or quote it: \"12:30\"\n"
      "    1 | a: 12:30\n"
      "      |    ^~~~~\n");
  for (const char* word : {"y",  "N",          "no",   "on",   "OFF",   "Yes",   "True",    "FALSE", "08",
                           "00", "-012",       "0o17", "0b10", "1_000", "0x1_0", "1:20:30", "1.5",   ".5",
                           "3.", "2024-01-31", "1e3",  ".inf", "-.INF", ".nan",  "1.5e-3",  "1:30.5"}) {
    INFO(word);
    const Checked file(std::string("a: ") + word + "\n");
    CHECK(file.diagnostics.error_count() == 1);
    REQUIRE(file.root);
    CHECK(file.root->find("a")->faulty());
  }
}

TEST_CASE("Duplicate keys are named with both places") {
  CHECK(Checked("a: 1\nb: {x: 1, x: 2}\na: 3\n").messages() ==
        "x.yaml:2:11: error: duplicate key 'x'; it is already given at 2:5\n"
        "    2 | b: {x: 1, x: 2}\n"
        "      |           ^\n"
        "x.yaml:3:1: error: duplicate key 'a'; it is already given at 1:1\n"
        "    3 | a: 3\n"
        "      | ^\n");
}

TEST_CASE("Anchors, aliases, merge keys and tags are refused, all of them at once") {
  const std::string anchors =
      "anchors and aliases (& and *) are not allowed; write the value out: a reader sees it where it is used\n";
  const std::string tags = "tags (!) are not allowed; quote the text if it begins with an exclamation mark\n";
  CHECK(Checked("a: &x 1\nb: *x\n<<: {c: 1}\nd: !!str 1\ne: !t [1]\nf: !\n").brief() ==
        "1:4 " + anchors + "2:4 " + anchors +
            "3:1 merge keys (<<) are not allowed; YAML readers disagree on them; write the keys out\n" +
            "4:4 " + tags + "5:4 " + tags + "6:4 " + tags);
  CHECK(Checked("a: *nobody\n").brief() ==
        "1:4 anchors and aliases (& and *) are not allowed; quote a text that begins with '*'\n");
}

TEST_CASE("A file holds exactly one document") {
  CHECK(Checked("---\na: 1\n...\n").messages().empty());
  CHECK(Checked("a: 1\n---\nb: 2\n").brief() ==
        "2:1 a second document begins here; a file holds one document\n");
  CHECK(Checked("[1] 2\n").brief() ==
        "1:5 the document has ended before this text; check the indentation and the brackets\n");
  CHECK(Checked("%YAML 1.2\n---\na: 1\n").brief() == "1:1 directives (%) are not allowed; remove the line\n");
  CHECK(Checked("").messages() == "x.yaml:1:1: error: the file holds nothing\n");
  CHECK(Checked("# only this\n").brief() == "1:1 the file holds nothing\n");
  CHECK(Checked("---\n").brief() == "1:1 the file holds nothing\n");
}

TEST_CASE("Values and keys that are not there are refused where that matters") {
  CHECK(Checked("a: ~\nb: Null\n").brief() ==
        "1:4 '~' means no value in YAML; leave the key out, or quote the text\n"
        "2:4 'Null' means no value in YAML; leave the key out, or quote the text\n");
  const Checked empty("a: [1, , 2]\nb:\n  -\n  - x\n");
  CHECK(empty.root->find("a")->items().at(1).position() == Position{1, 6});
  CHECK(empty.root->find("b")->items().at(0).position() == Position{3, 3});
  CHECK(Checked("nullable: null-ish\n").brief().empty());
  CHECK(Checked("? [a]\n: 1\n").brief() == "1:3 a key must be a word, not a list\n");
  CHECK(Checked("{a: 1,, b: 2}\n").brief() == "1:6 a key must be a word, not nothing\n");
}

TEST_CASE("A quote that is never closed is shown where it opens") {
  CHECK(Checked("a: 1\nb: \"abc\nc: d\n").messages() ==
        "x.yaml:2:4: error: this quote is never closed\n    2 | b: \"abc\n      |    ^~~~\n");
  CHECK(Checked("a: 1\nb: 'abc").brief() == "2:4 this quote is never closed\n");
  CHECK(
      Checked("a: \"abc\nb: \"x\"\n").brief() ==
      "2:5 this does not fit into the mapping around it; the text quoted in line 1 goes on over several lines: is a "
      "closing quote missing there?\n");
  CHECK(Checked("a: \"x'\"\nb: 'it''s'\nc: \"\\\"\"\n").messages().empty());
}

TEST_CASE("Tabs in the indentation are named as such") {
  const std::string tab = "tab in the indentation; use spaces\n";
  CHECK(Checked("a:\n\tb: 1\n").messages() ==
        "x.yaml:2:1: error: tab in the indentation; use spaces\n    2 |     b: 1\n      | ^~~~\n");
  CHECK(Checked("a:\n  b: 1\n\tc: 2\n").brief() == "3:1 " + tab);
  CHECK(Checked("a:\n\t- b\n").brief() == "2:1 " + tab);
  CHECK(Checked("a: {b: 1,\n \tc: 2}\n").brief() == "2:2 " + tab);
  CHECK(Checked("a: |\n  \tin a text\n").messages().empty());
  CHECK(Checked("a: 1\t# behind a value\n").messages().empty());
}

TEST_CASE("Broken syntax is explained in words of the author") {
  CHECK(
      Checked("a: foo: bar\n").brief() ==
      "1:7 a ':' is not possible here; check the indentation, or quote text that holds a colon followed by a space\n");
  CHECK(Checked("a: [1, 2\nb: 3\n").brief() == "2:2 a '[' is not closed before this; add ']' or ','\n");
  CHECK(Checked("a: {x: 1\n").brief() == "1:9 a '{' is not closed before this; add '}' or ','\n");
  CHECK(Checked("a: ]\n").brief() == "1:4 this bracket closes nothing\n");
  CHECK(Checked("x: - y\n").brief() ==
        "1:4 a list item ('- ') is not possible here; begin the list on a line of its own\n");
  CHECK(Checked("a: @x\n").brief() == "1:4 a plain text cannot begin with this character; quote it\n");
  CHECK(Checked("a: \"\\q\"\n").brief() ==
        "1:7 unknown escape sequence; in \"...\" write \\\\ for a backslash, or use '...'\n");
}

TEST_CASE("What was found before the syntax broke is reported too") {
  CHECK(Checked("a: 010\na: b\nc: ]\n").diagnostics.error_count() == 2);
}

TEST_CASE("CR LF files and a byte order mark read like any other") {
  const Checked file("\xEF\xBB\xBF"
                     "a: 1\r\ntalk: |\r\n  > x\r\n  < y\r\n");
  REQUIRE(file.messages().empty());
  CHECK(file.root->find("talk")->text() == "> x\n< y\n");
  CHECK(file.root->find("talk")->line_position(1) == Position{4, 3});
}

}  // namespace
