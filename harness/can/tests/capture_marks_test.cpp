// SPDX-License-Identifier: Apache-2.0
#include "can/capture_marks.hpp"

#include "can/capture.hpp"
#include "catch.hpp"

using namespace conform::can;

TEST_CASE("what a frame is part of is written into its comment and read back") {
  const std::string name = "cia301/sdo/upload/basic[1000h:00]";
  for (const auto part : {CasePart::preparation, CasePart::begin, CasePart::end, CasePart::putting_back}) {
    const auto read = parse_case_mark(to_comment({.name = name, .part = part}));
    REQUIRE(read);
    CHECK(read->name == name);
    CHECK(read->part == part);
    CHECK(read->number == 0);
  }
  const auto step =
      to_comment({.name = name, .part = CasePart::step, .number = 12, .words = "upload 1000h:00"});
  CHECK(step == "case cia301/sdo/upload/basic[1000h:00] step 12: upload 1000h:00");
  const auto read = parse_case_mark(step);
  REQUIRE(read);
  CHECK(read->name == name);
  CHECK(read->part == CasePart::step);
  CHECK(read->number == 12);
  CHECK(read->words == "upload 1000h:00");
  CHECK(parse_case_mark("case a cleanup 1")->part == CasePart::cleanup);
}

TEST_CASE("the words of a step that sound like another mark do not end the case") {
  const auto read = parse_case_mark("case a/b step 3: wait for the end");
  REQUIRE(read);
  CHECK(read->name == "a/b");
  CHECK(read->part == CasePart::step);
}

TEST_CASE("other comments are no marks of a case") {
  for (const auto* text : {"", "case ", "case a", "case  begin", "case step 1", "fail SDO-1: no answer",
                           "case a step 0", "case a step x", "the cases are over"})
    CHECK_FALSE(parse_case_mark(text));
}

TEST_CASE("a copied frame has a comment of its own, and none takes no room") {
  CapturedFrame frame;
  CHECK(frame.comment.empty());
  CHECK(frame.comment.view().empty());
  frame.comment = "first";
  CapturedFrame copy = frame;
  copy.comment.append(", then more");
  CHECK(frame.comment == "first");
  CHECK(copy.comment.contains("then"));
  copy = frame;
  CHECK(copy.comment == frame.comment);
  copy.comment = "";
  CHECK(copy.comment.empty());
}

TEST_CASE("several marks of one frame are told apart") {
  Capture capture;
  capture.add(CapturedFrame{});
  capture.comment(0, to_comment({.name = "a", .part = CasePart::begin}));
  capture.comment(0, to_comment({.name = "a", .part = CasePart::step, .number = 1, .words = "wait"}));
  capture.comment(0, "fail X: nothing came");
  CHECK(capture.frames()[0].comment == "case a begin; case a step 1: wait; fail X: nothing came");
  const auto marks = case_marks(capture.frames()[0].comment.view());
  REQUIRE(marks.size() == 2);
  CHECK(marks[0].part == CasePart::begin);
  CHECK(marks[1].words == "wait");
}
