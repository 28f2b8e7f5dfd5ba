// SPDX-License-Identifier: Apache-2.0
// Conversations: reading lines, building frames to send, comparing frames that came.
#include "steps/conversation.hpp"

#include "catch.hpp"
#include "steps/tests/fake_session.hpp"

namespace {

using namespace conform;
using namespace conform::steps;

constexpr Multiplexer name_entry{Index(0x1008), SubIndex(0)};

Line line(std::string_view text) {
  std::vector<Problem> problems;
  auto lines = parse_conversation(text, problems);
  REQUIRE(problems.empty());
  REQUIRE(lines.size() == 1);
  return std::move(lines.front());
}

std::string problem(std::string_view text) {
  std::vector<Problem> problems;
  (void)parse_conversation(text, problems);
  REQUIRE(problems.size() == 1);
  const auto& only = problems.front();
  return std::to_string(only.line) + ":" + std::to_string(only.column) + "+" + std::to_string(only.length) +
         " " + only.what;
}

std::string built(std::string_view text, FakeSession& session) {
  const auto frame = build_frame(line(text), session, name_entry);
  if (!frame) return "error: " + frame.error().what;
  return to_string(CanId(frame->id)) + (frame->remote ? " RTR" : "") + (frame->extended ? " EXT" : "") + " " +
         hex_bytes(frame->bytes());
}

Comparison compared(std::string_view text, const Bytes& bytes, FakeSession& session) {
  return compare(line(text), can::data_frame(CanId(0x585), bytes), session, name_entry);
}
Comparison compared(std::string_view text, const Bytes& bytes) {
  FakeSession session;
  return compared(text, bytes, session);
}

TEST_CASE("Lines are sent, must come, or ask for silence") {
  std::vector<Problem> problems;
  const auto lines = parse_conversation(
      "> 600+N: 40 {m} ..   # upload\n\n< 7E5h: xx within 200 ms\nsilence 580+N for T_QUIET\n", problems);
  REQUIRE(problems.empty());
  REQUIRE(lines.size() == 3);
  CHECK(lines[0].kind == Line::Kind::send);
  CHECK(lines[0].can_id(NodeId(5)) == CanId(0x605));
  CHECK(lines[0].text == "> 600+N: 40 {m} ..");
  CHECK(lines[1].kind == Line::Kind::receive);
  CHECK(lines[1].can_id(NodeId(5)) == CanId(0x7E5));
  REQUIRE(lines[1].time);
  CHECK(lines[1].time->text() == "200 ms");
  CHECK(lines[1].number == 2);
  CHECK(lines[2].kind == Line::Kind::silence);
  CHECK(lines[2].time->resolve(device::default_profile(NodeId(5))) ==
        device::default_profile(NodeId(5)).quiet_time);
}

TEST_CASE("A line to send becomes a frame") {
  FakeSession session;
  session.names["data"] = Value::of_bytes({1, 2, 3, 4, 5, 6, 7, 8, 9});
  session.names["number"] = Value::of_number(0x1234);
  CHECK(built("> 600+N: 40 {m} 00 00 00 00", session) == "605h 40 08 10 00 00 00 00 00");
  CHECK(built("> 600+N: 40 ..", session) == "605h 40 00 00 00 00 00 00 00");
  CHECK(built("> 0: 81 N", session) == "000h 81 05");
  CHECK(built("> 600+N: 00 {data@2:7}", session) == "605h 00 03 04 05 06 07 08 09");
  CHECK(built("> 600+N: {number:2} xx zz", session) == "605h 34 12 00 00");
  CHECK(built("> 600+N: 80 {m} {abort: 0503 0000h}", session) == "605h 80 08 10 00 00 00 03 05");
  CHECK(built("> 1F0+N: RTR", session).starts_with("1F5h RTR"));
  CHECK(built("> 600+N: 40 EXT DLC1", session) == "605h EXT 40");
  CHECK(built("> 600+N: {other:4}", session) == "error: {other} has no value here");
  CHECK(built("> 600+N: {data}", session) == "error: more than eight bytes in '> 600+N: {data}'");
}

TEST_CASE("Bytes that came are compared one after the other, and the first wrong one is told") {
  CHECK(compared("< 580+N: 41 {m} 04 00 00 00", {0x41, 0x08, 0x10, 0, 4, 0, 0, 0}).equal);
  const auto wrong = compared("< 580+N: 41 {m} 04 00 00 00", {0x41, 0x08, 0x10, 0, 5, 0, 0, 0});
  CHECK_FALSE(wrong.equal);
  CHECK(wrong.first_wrong == 4U);
  CHECK(wrong.reason == "byte 4 is 05h");
  CHECK(compared("< 580+N: 4x xx", {0x4F, 0xAA}).equal);
  CHECK(compared("< 580+N: 4x xx", {0x5F, 0xAA}).first_wrong == 0U);
  CHECK(compared("< 580+N: 41 ..", {0x41, 1, 2, 3}).equal);
  CHECK(compared("< 580+N: N", {5}).equal);
  CHECK(compared("< 580+N: N", {6}).reason == "byte 0 is not the node-ID");
  CHECK(compared("< 580+N: 41 {m} ..", {0x41, 0x09, 0x10, 0}).reason ==
        "the multiplexer is not that of 1008h:00");
}

TEST_CASE("A frame that is too short or too long is wrong where it ends") {
  const auto brief = compared("< 580+N: 41 00 00", {0x41, 0});
  CHECK(brief.first_wrong == 2U);
  CHECK(brief.reason == "the frame ends after 2 bytes");
  const auto longer = compared("< 580+N: 41", {0x41, 0});
  CHECK(longer.first_wrong == 1U);
  CHECK(longer.reason == "the frame has 2 bytes instead of 1");
  CHECK(compared("< 580+N: {m}", {}).reason == "the frame ends after 0 bytes");
}

TEST_CASE("A frame of another kind is wrong even when its bytes are right") {
  FakeSession session;
  auto frame = can::data_frame(CanId(0x585), Bytes{0x60, 0, 0x10, 0});
  frame.extended = true;
  CHECK(compare(line("< 580+N: 60 .."), frame, session, name_entry).reason ==
        "the identifier has 29 bits instead of 11");
  CHECK(compare(line("< 580+N: 60 00 10 00 EXT"), frame, session, name_entry).equal);
  frame.extended = false;
  frame.remote = true;
  CHECK(compare(line("< 580+N: .."), frame, session, name_entry).reason == "a remote frame");
}

TEST_CASE("Reserved bytes and second-best abort codes are tolerated with a remark") {
  const auto reserved = compared("< 580+N: 60 zz", {0x60, 1});
  CHECK(reserved.equal);
  CHECK(reserved.tolerated == std::vector<std::string>{"reserved byte 1 is 01h instead of 00h"});
  const std::string text = "< 580+N: 80 {m} {abort: 0503 0000h; warn 0504 0001h, 0800 0000h}";
  CHECK(compared(text, {0x80, 0x08, 0x10, 0, 0, 0, 0x03, 0x05}).tolerated.empty());
  CHECK(compared(text, {0x80, 0x08, 0x10, 0, 0, 0, 0, 0x08}).tolerated.size() == 1);
  const auto other = compared(text, {0x80, 0x08, 0x10, 0, 0, 0, 2, 0x06});
  CHECK_FALSE(other.equal);
  CHECK(other.first_wrong == 4U);
}

TEST_CASE("'warn any' tolerates every abort code but those that are ruled out") {
  const std::string text = "< 580+N: 80 {m} {abort: 0607 0010h; warn any; fail 0607 0013h}";
  const auto with = [&](std::uint8_t low, std::uint8_t high) {
    return compared(text, {0x80, 0x08, 0x10, 0, low, 0, high, 0x06});
  };
  CHECK(with(0x10, 7).tolerated.empty());
  CHECK(with(0x12, 7).equal);
  CHECK(with(0x12, 7).tolerated.size() == 1);
  CHECK(with(0, 2).tolerated.size() == 1);
  CHECK_FALSE(with(0x13, 7).equal);
}

TEST_CASE("Names remember what came, and must come again the same") {
  FakeSession session;
  const auto first = compared("< 580+N: 41 {size:4} {rest}", {0x41, 9, 0, 0, 0, 7, 8}, session);
  REQUIRE(first.equal);
  REQUIRE(first.names.size() == 2);
  CHECK(first.names[0] == std::pair<std::string, Bytes>("size", {9, 0, 0, 0}));
  CHECK(first.names[1].second == Bytes{7, 8});
  session.names["size"] = Value::of_bytes({9, 0, 0, 0});
  CHECK(compared("< 580+N: 41 {size:4}", {0x41, 9, 0, 0, 0}, session).equal);
  CHECK(compared("< 580+N: 41 {size:4}", {0x41, 8, 0, 0, 0}, session).reason == "{size} differs from before");
}

TEST_CASE("Of a slice that reaches beyond the data the last bytes are unused") {
  FakeSession session;
  session.names["whole"] = Value::of_bytes({1, 2, 3, 4, 5, 6, 7, 8, 9});
  CHECK(compared("< 580+N: 1x {whole@7:7}", {0x1B, 8, 9, 0, 0, 0, 0, 0}, session).equal);
  CHECK(compared("< 580+N: 1x {whole@7:7}", {0x1B, 8, 9, 0xAA, 0, 0, 0, 0}, session).equal);
  CHECK_FALSE(compared("< 580+N: 1x {whole@7:7}", {0x1B, 8, 8, 0, 0, 0, 0, 0}, session).equal);
  CHECK_FALSE(compared("< 580+N: 1x {whole@7:7}", {0x1B, 8, 9}, session).equal);
  // Nothing is left to compare with, or no slice was asked for.
  CHECK_FALSE(compared("< 580+N: 1x {whole@9:7}", {0x1B, 0, 0, 0, 0, 0, 0, 0}, session).equal);
  session.names["short"] = Value::of_bytes({1, 2});
  CHECK_FALSE(compared("< 580+N: 1x {short:7}", {0x1B, 1, 2, 0, 0, 0, 0, 0}, session).equal);
}

TEST_CASE("Every mistake of a conversation has its line, column and length") {
  CHECK(problem("> 600+N: 40 1O") == "0:12+2 '1O' is not a byte");
  CHECK(problem("\n  > 600+M: 40") == "1:4+5 '600+M' is not a CAN-ID");
  CHECK(problem("> 600+N 40") == "0:8+1 ':' is missing behind the CAN-ID");
  CHECK(problem("600+N: 40") == "0:0+1 a line begins with '>', '<' or 'silence'");
  CHECK(problem("> 600+N: {m") == "0:9+1 '}' is missing");
  CHECK(problem("> 600+N: .. 00") == "0:12+1 '..' must be the last of the bytes");
  CHECK(problem("> 600+N: 0 1 2").starts_with("0:9+1 '0' is not a byte"));
  CHECK(problem("> 1FFFFFFF+1: 00") == "0:2+10 '1FFFFFFF+1' is beyond 29 bits");
  CHECK(problem("> 20000000: 00") == "0:2+8 '20000000' is not a CAN-ID");
  CHECK(problem("> 600: {m} {m} {m}") == "0:18+1 more than eight bytes in a CAN frame");
  CHECK(problem("< 580+N: {size:9}") == "0:9+8 a number of bytes from 1 to 8 is missing behind ':'");
  CHECK(problem("< 580+N: 40 within soon") == "0:19+4 'soon' is not a duration");
  CHECK(problem("silence 580+N") == "0:13+1 'for' and a time are missing");
  CHECK(problem("silence 580+N for T_NONE") == "0:18+6 unknown time 'T_NONE'");
  // Columns count characters: the sign of the micro takes two bytes.
  CHECK(problem("> 600+N: \xC2\xB5\xC2\xB5 00") == "0:9+2 '\xC2\xB5\xC2\xB5' is not a byte");
}

TEST_CASE("All lines with mistakes are told at once, the others are kept") {
  std::vector<Problem> problems;
  const auto lines = parse_conversation("> 600+N: 4\n> 600+N: 40\n< 580+N\n", problems);
  CHECK(lines.size() == 1);
  REQUIRE(problems.size() == 2);
  CHECK(problems[0].line == 0);
  CHECK(problems[1].line == 2);
}

}  // namespace
