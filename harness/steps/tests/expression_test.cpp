// SPDX-License-Identifier: Apache-2.0
// Tokens, expressions, objects and ranges: what they are worth, and what is said where they cannot be read.
#include "steps/expression.hpp"

#include "catch.hpp"
#include "steps/tests/fake_session.hpp"
#include "steps/tokens.hpp"

namespace {

using namespace conform;
using namespace conform::steps;

std::string tokens(std::string_view text) {
  const auto list = tokenize(text);
  if (!list) return list.error().text();
  std::string out;
  for (const auto& token : *list) out += (out.empty() ? "" : " | ") + token.text;
  return out;
}

std::string worth(std::string_view text, FakeSession& session) {
  const auto expression = Expression::parse(text);
  if (!expression) return "refused: " + expression.error().text();
  const auto value = expression->evaluate(session);
  return value ? value->text() : "error: " + value.error().what;
}
std::string worth(std::string_view text) {
  FakeSession session;
  return worth(text, session);
}

std::string object(std::string_view text, FakeSession& session) {
  const auto reference = ObjectReference::parse(text);
  if (!reference) return "refused: " + reference.error().text();
  const auto mux = reference->resolve(session);
  return mux ? to_string(*mux) : "error: " + mux.error().what;
}

constexpr Multiplexer error_count{Index(0x1003), SubIndex(0)};

TEST_CASE("Groups of four digits that end in h are one word") {
  CHECK(tokens("0609 0030h") == "06090030h");
  CHECK(tokens("8000 06A0h | $id") == "800006A0h | | | $id");
  CHECK(tokens("2710 016E 3600h") == "2710016E3600h");
  CHECK(tokens("0123 4567 89AB CDEFh") == "0123456789ABCDEFh");
  CHECK(tokens("1234 5") == "1234 | 5");
  CHECK(tokens("123 4567h") == "123 | 4567h");
}

TEST_CASE("Operators need no blanks around them, names may hold dots") {
  CHECK(tokens("~($a+1)") == "~ | ( | $a | + | 1 | )");
  CHECK(tokens("1003h:00 >= 2") == "1003h:00 | >= | 2");
  CHECK(tokens("$profile.store_timeout") == "$profile.store_timeout");
  CHECK(tokens("1..240") == "1 | .. | 240");
  CHECK(tokens("a;b") == "unexpected character ';' (in 'a;b')");
  CHECK(tokens("").empty());
}

TEST_CASE("Numbers are worth what they say, in every notation") {
  CHECK(worth("17") == "11h");
  CHECK(worth("1Fh") == "1Fh");
  CHECK(worth("0x1F") == "1Fh");
  CHECK(worth("0609 0030h") == "06090030h");
  CHECK(worth("N") == "05h");
}

TEST_CASE("The operators are + - | & ^ and ~, from left to right") {
  CHECK(worth("80h + N") == "85h");
  CHECK(worth("10 - 3 - 2") == "05h");
  CHECK(worth("F0h | 0Fh") == "FFh");
  CHECK(worth("FFh & 3Ch & 0Fh") == "0Ch");
  CHECK(worth("FFh ^ 0Fh") == "F0h");
  CHECK(worth("~FEh & FFh") == "01h");
  CHECK(worth("(1 + 2) & 3") == "03h");
  CHECK(worth("~(~1)") == "01h");
}

TEST_CASE("Mixed operators without parentheses are refused") {
  CHECK(worth("1 + 2 | 4") == "refused: '+' and '|' are mixed (use parentheses: there is no precedence)");
}

TEST_CASE("What is no expression is refused with the word that is wrong") {
  CHECK(worth("") == "refused: a value is missing");
  CHECK(worth("1 +") == "refused: a value is missing");
  CHECK(worth("(1") == "refused: ')' is missing");
  CHECK(worth("1 2") == "refused: '2' is not expected here");
  CHECK(worth("$") == "refused: a name is missing after '$'");
  CHECK(worth("010") ==
        "refused: '010' is not a number, a $name, N or current (write 17, 1Fh, 0x1F or 0609 0030h)");
  CHECK(worth("many") ==
        "refused: 'many' is not a number, a $name, N or current (write 17, 1Fh, 0x1F or 0609 0030h)");
  CHECK(worth("bit 64 of 1005h:00") == "refused: 'bit' needs a number from 0 to 63");
  CHECK(worth("value of") == "refused: '' is not an object (write 1003h:00, $object or 1003h:$count)");
  CHECK(worth(std::string(2000, '(')) == "refused: a text of 2000 characters (write at most 1000)");
}

TEST_CASE("Names, the current value and entries are looked up when the expression is evaluated") {
  FakeSession session;
  session.names["count"] = Value::of_number(3);
  session.names["name"] = Value::of_bytes(Bytes(9, 0x41));
  session.names["late"] = Value::of_word("current");
  session.current_value = Value::of_number(7);
  session.entries[error_count] = {2};
  CHECK(worth("$count + 1", session) == "04h");
  CHECK(worth("current", session) == "07h");
  CHECK(worth("$late", session) == "07h");
  CHECK(worth("value of 1003h:00", session) == "02h");
  CHECK(worth("bit 1 of 1003h:00", session) == "01h");
  CHECK(worth("bit 0 of 1003h:00", session) == "00h");
  CHECK(worth("$name", session) == "41 41 41 41 41 41 41 41 41");
  CHECK(worth("$name + 1", session) ==
        "error: '41 41 41 41 41 41 41 41 41' is not a number of up to 64 bits");
  CHECK(worth("$other", session) == "error: $other has no value, as no step has brought one");
  CHECK(worth("value of 1001h:00", session) == "error: 1001h:00 cannot be read");
  CHECK(worth("low limit of 1003h:00", session) == "error: nothing is known of 1003h:00");
  session.defaults[error_count] = {9};
  CHECK(worth("default of 1003h:00", session) == "09h");
}

TEST_CASE("An expression tells the names it uses") {
  const auto expression = Expression::parse("$a + value of $b:$c");
  REQUIRE(expression);
  CHECK(expression->names() == std::vector<std::string>{"a", "c", "b"});
  CHECK(expression->text() == "$a + value of $b:$c");
}

TEST_CASE("Values compare as bytes where both are bytes, as numbers otherwise") {
  CHECK(Value::of_bytes({1, 0}).same_as(Value::of_number(1)));
  CHECK_FALSE(Value::of_bytes({1, 0}).same_as(Value::of_bytes({1})));
  CHECK(Value::of_object(error_count).same_as(Value::of_object(error_count)));
  CHECK_FALSE(Value::of_word("a").same_as(Value::of_number(1)));
}

TEST_CASE("Objects are written out or named, with sub-indices in hexadecimal or computed") {
  FakeSession session;
  session.names["object"] = Value::of_object({Index(0x2000), SubIndex(3)});
  session.names["index"] = Value::of_number(0x1A00);
  session.names["n"] = Value::of_number(2);
  session.names["big"] = Value::of_number(0x100);
  CHECK(object("1003h:10", session) == "1003h:10");
  CHECK(object("1003h", session) == "1003h:00");
  CHECK(object("$object", session) == "2000h:03");
  CHECK(object("$object:00", session) == "2000h:00");
  CHECK(object("$index:$n", session) == "1A00h:02");
  CHECK(object("1018h:($n + 1)", session) == "1018h:03");
  CHECK(object("1018h:$big", session) == "error: sub-index 256 is above FFh");
  CHECK(object("$big", session) == "0100h:00");
  CHECK(object("$other", session) == "error: $other has no value, as no step has brought one");
  CHECK(object("1003", session) ==
        "refused: '1003' is not an object (write 1003h:00, $object or 1003h:$count)");
  CHECK(object("1003h:100", session) ==
        "refused: '100' is not a sub-index (write two hexadecimal digits: 1003h:0A)");
  CHECK(object("$:1", session) == "refused: a name is missing after '$'");
  CHECK(ObjectReference::parse("1003h:00")->literal() == error_count);
  CHECK_FALSE(ObjectReference::parse("$object")->literal());
}

TEST_CASE("A range includes its ends, and either may be open") {
  FakeSession session;
  session.names["most"] = Value::of_number(10);
  const auto holds = [&](std::string_view text, std::uint64_t value) {
    return *Range::parse(text)->holds(value, session);
  };
  CHECK(holds("1..240", 1));
  CHECK(holds("1..240", 240));
  CHECK_FALSE(holds("1..240", 0));
  CHECK_FALSE(holds("1..240", 241));
  CHECK(holds("..FFh", 0));
  CHECK(holds("1..", ~std::uint64_t{0}));
  CHECK(holds("1..$most", 10));
  CHECK_FALSE(holds("1..$most + 1", 12));
  CHECK_FALSE(Range::parse("1..$none")->holds(2, session));
}

TEST_CASE("Bounds of signed values are sign-extended") {
  FakeSession session;
  const auto range = Range::parse("~0..5");
  REQUIRE(range);
  CHECK(*range->holds_signed(~std::uint64_t{0}, session));
  CHECK(*range->holds_signed(5, session));
  CHECK_FALSE(*range->holds_signed(6, session));
  CHECK_FALSE(*range->holds_signed(~std::uint64_t{1}, session));
}

TEST_CASE("What is no range is refused") {
  CHECK(Range::parse("1-240").error().text() == "'1-240' is not a range (write 1..240, 1.. or ..FFh)");
  CHECK(Range::parse("..").error().text() == "a range needs at least one end");
  CHECK(Range::parse("1..many").error().what.find("'many' is not a number") != std::string::npos);
}

}  // namespace
