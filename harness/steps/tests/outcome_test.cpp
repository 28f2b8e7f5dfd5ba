// SPDX-License-Identifier: Apache-2.0
// Outcomes: how they are read, what they match, and how a graded set decides.
#include "steps/outcome.hpp"

#include "catch.hpp"
#include "steps/tests/fake_session.hpp"
#include "yaml/loader.hpp"

namespace {

using namespace conform;
using namespace conform::steps;
using result::Verdict;

/// The outcomes of `expect: TEXT`, and what is wrong with them.
std::vector<Outcome> read(const std::string& text, std::string& said) {
  const auto source = yaml::make_source("x.yaml", "expect: " + text + "\n");
  yaml::Diagnostics diagnostics(source);
  const auto root = yaml::load(*source, diagnostics);
  REQUIRE(root);
  const yaml::Field field(root->find("expect"), diagnostics, "'expect'");
  auto out = parse_outcomes(field, {"before"});
  said = diagnostics.render();
  return out;
}
std::vector<Outcome> read(const std::string& text) {
  std::string said;
  auto out = read(text, said);
  CHECK(said.empty());
  return out;
}
std::string mistake(const std::string& text) {
  std::string said;
  (void)read(text, said);
  const auto message = said.find("error: ");
  return message == std::string::npos ? said : said.substr(message + 7, said.find('\n') - message - 7);
}

Actual uploaded(Bytes data, std::optional<canopen::DataType> type = {}) {
  Actual out;
  out.kind = Actual::Kind::confirmed;
  out.data = std::move(data);
  out.has_data = true;
  out.type = type;
  return out;
}
Actual aborted(std::uint32_t code) {
  Actual out;
  out.kind = Actual::Kind::aborted;
  out.code = AbortCode(code);
  return out;
}
Actual silent() {
  Actual out;
  out.kind = Actual::Kind::silence;
  return out;
}

bool fits(const std::string& text, const Actual& actual) {
  FakeSession session;
  session.names["before"] = Value::of_bytes({0xE8, 0x03});
  for (const auto& outcome : read(text)) {
    const auto hit = outcome.matches(actual, session);
    REQUIRE(hit);
    if (*hit) return true;
  }
  return false;
}

TEST_CASE("An abort code may be the value of a name") {
  FakeSession session;
  session.names["before"] = Value::of_number(0x0609'0030);
  for (const char* text : {"abort $before", "{abort: $before}"}) {
    const auto outcomes = read(text);
    REQUIRE(outcomes.size() == 1);
    Actual actual;
    actual.kind = Actual::Kind::aborted;
    actual.code = AbortCode(0x0609'0030);
    CHECK(*outcomes[0].matches(actual, session));
    actual.code = AbortCode(0x0601'0002);
    CHECK_FALSE(*outcomes[0].matches(actual, session));
    CHECK(outcomes[0].words(session, std::nullopt).starts_with("abort 0609 0030h"));
  }
  CHECK(mistake("abort $nothing").find("nothing") != std::string::npos);
}

TEST_CASE("A misspelt outcome is named at its place, with what was meant") {
  std::string said;
  (void)read("{abbort: 0609 0030h}", said);
  CHECK(said == "x.yaml:1:10: error: unknown outcome 'abbort'; did you mean 'abort'?\n"
                "    1 | expect: {abbort: 0609 0030h}\n"
                "      |          ^~~~~~\n");
  CHECK(mistake("unchangd") == "unknown outcome 'unchangd'; did you mean 'unchanged'?");
  CHECK(mistake("abort") == "'abort' needs a code; write abort 0609 0030h, or abort any");
  CHECK(mistake("abort 0609 0031") == "'0609 0031' is not an abort code; write 0609 0030h, or any");
  CHECK(mistake("abort 0609 0099h") ==
        "abort code 0609 0099h is reserved in CiA 301; see the table of abort codes, 7.2.4.3.17");
  CHECK(mistake("{value: $befor}") == "unknown name $befor; did you mean $before?");
  CHECK(mistake("{count: 9-11}") == "'9-11' is not a range; write 9..11, 90 ms..110 ms or 10");
  CHECK(mistake("{size: small..}") ==
        "'small' is not a number, a $name, N or current; write 4, 1.. or declared");
}

TEST_CASE("Words match how a transfer ended") {
  CHECK(fits("ok", uploaded({1})));
  CHECK_FALSE(fits("ok", aborted(0x06090030)));
  CHECK(fits("abort any", aborted(0x08000000)));
  CHECK(fits("abort 0609 0030h", aborted(0x06090030)));
  CHECK_FALSE(fits("abort 0609 0030h", aborted(0x06090031)));
  CHECK(fits("{abort: [0609 0030h, 0609 0031h]}", aborted(0x06090031)));
  CHECK(fits("abort 0601 0000h..0601 0002h", aborted(0x06010001)));
  CHECK(fits("silence", silent()));
  CHECK_FALSE(fits("[ok, abort any]", silent()));
}

TEST_CASE("A value is compared in the width of the data") {
  CHECK(fits("{value: 1000}", uploaded({0xE8, 0x03})));
  CHECK(fits("{value: 1000}", uploaded({0xE8, 0x03, 0, 0})));
  CHECK_FALSE(fits("{value: 1000}", uploaded({0xE8})));
  CHECK(fits("{value: ~0}", uploaded({0xFF, 0xFF})));
  CHECK(fits("{mask: 7FFFh, value: 1}", uploaded({0x01, 0x80})));
  CHECK_FALSE(fits("{mask: 7FFFh, value: 1}", uploaded({0x02, 0x80})));
  // Bytes that were saved must come back byte by byte.
  CHECK(fits("{value: $before}", uploaded({0xE8, 0x03})));
  CHECK_FALSE(fits("{value: $before}", uploaded({0xE8, 0x03, 0, 0})));
  CHECK_FALSE(fits("{value: 0}", uploaded({})));
}

TEST_CASE("A DOMAIN of fixed length holds what was written to its beginning, any other entry nothing else") {
  auto window = uploaded({0xE8, 0x03, 0, 0}, canopen::DataType::domain);
  CHECK_FALSE(fits("{holds: $before}", window));  // nobody knows how long it was before
  window.unchanged_from = Bytes{9, 9, 0, 0};
  CHECK(fits("{holds: $before}", window));
  window.unchanged_from = Bytes{9, 9, 0};
  CHECK_FALSE(fits("{holds: $before}", window));
  window.unchanged_from = Bytes{9, 9, 0, 0};
  window.data[1] = 4;
  CHECK_FALSE(fits("{holds: $before}", window));
  window = uploaded({0xE8, 0x03, 0, 0}, canopen::DataType::visible_string);
  window.unchanged_from = Bytes{9, 9, 0, 0};
  CHECK_FALSE(fits("{holds: $before}", window));
  CHECK(fits("{holds: $before}", uploaded({0xE8, 0x03})));
}

TEST_CASE("All demands of one mapping must be met") {
  CHECK(fits("{size: 1, range: 1..3}", uploaded({3})));
  CHECK_FALSE(fits("{size: 1, range: 1..3}", uploaded({4})));
  CHECK_FALSE(fits("{size: 1, range: 1..3}", uploaded({3, 0})));
  CHECK(fits("{one_of: [1, 1000]}", uploaded({0xE8, 0x03})));
  CHECK_FALSE(fits("{one_of: [1, 2]}", uploaded({3})));
  CHECK(fits("{bytes: \"E8 03\"}", uploaded({0xE8, 0x03})));
  CHECK(fits("{text: visible}", uploaded({0x41, 0x7E, 0x00})));
  CHECK_FALSE(fits("{text: visible}", uploaded({0x41, 0x7F})));
  CHECK(fits("{size: declared}", uploaded({1, 0}, canopen::DataType::unsigned16)));
  CHECK_FALSE(fits("{size: declared}", uploaded({1}, canopen::DataType::unsigned16)));
  CHECK(fits("{size: declared}", uploaded({1, 2, 3}, canopen::DataType::visible_string)));
}

TEST_CASE("A range may be asked of some bits only") {
  CHECK(fits("{mask: 7FFh, range: 181h..580h}", uploaded({0x85, 0x01, 0x00, 0xC0})));
  CHECK_FALSE(fits("{mask: 7FFh, range: 181h..580h}", uploaded({0x80, 0x01, 0x00, 0xC0})));
  CHECK(mistake("{mask: 7FFh}") == "'mask' needs 'value' or 'range' beside it");
}

TEST_CASE("A range of a signed entry knows negative numbers") {
  CHECK(fits("{range: ~1..5}", uploaded({0xFE}, canopen::DataType::integer8)));
  CHECK_FALSE(fits("{range: ~1..5}", uploaded({0xFD}, canopen::DataType::integer8)));
  CHECK_FALSE(fits("{range: 0..5}", uploaded({0xFE}, canopen::DataType::unsigned8)));
}

TEST_CASE("Measurements are numbers, times or states") {
  Actual actual;
  actual.measured = {{"count", 10}, {"period", 100'000'000}, {"state", 0x7F}};
  CHECK(fits("{count: 9..11, period: 90 ms..110 ms, state: pre-operational}", actual));
  CHECK(fits("{count: 10}", actual));
  CHECK(fits("{period: ..100 ms}", actual));
  CHECK_FALSE(fits("{period: 101 ms..}", actual));
  CHECK_FALSE(fits("{state: operational}", actual));
  CHECK_FALSE(fits("{longest: 1 s}", actual));
}

TEST_CASE("What is unchanged needs something to compare with") {
  FakeSession session;
  auto actual = uploaded({1});
  const auto outcome = read("unchanged").front();
  CHECK_FALSE(outcome.matches(actual, session));
  actual.unchanged_from = Bytes{1};
  CHECK(*outcome.matches(actual, session));
  actual.unchanged_from = Bytes{2};
  CHECK_FALSE(*outcome.matches(actual, session));
}

TEST_CASE("Outcomes say in words what was due, in the notation of the entry") {
  FakeSession session;
  session.names["before"] = Value::of_bytes({0xE8, 0x03});
  const auto words = [&](const std::string& text) {
    return read(text).front().words(session, canopen::DataType::unsigned16);
  };
  CHECK(words("ok") == "success");
  CHECK(words("silence") == "no answer");
  CHECK(words("unchanged") == "the value it had before");
  CHECK(words("abort any") == "any abort");
  CHECK(words("abort 0601 0000h..0601 0002h") == "abort 0601 0000h to 0601 0002h");
  CHECK(words("{size: 1}") == "1 byte");
  CHECK(words("{range: 1..240}") == "value 1..240");
  CHECK(words("{mask: 7FFh, range: 80h..100h}") == "value 80h..100h in the bits 07FFh");
  CHECK(words("{bytes: E8 03}") == "bytes E8 03");
  CHECK(words("{value: $before}").find("03E8h") != std::string::npos);
}

TEST_CASE(
    "A graded set passes what is listed, warns and fails what is named, and takes the rest by the level") {
  FakeSession session;
  Expectation expectation;
  expectation.pass = read("abort 0609 0030h");
  expectation.warn = read("abort 0609 0031h");
  expectation.fail = read("abort 0601 0000h");
  const auto verdict = [&](const Actual& actual, std::string_view level, bool strict = false) {
    const auto out = grade(expectation, actual, level, strict, session);
    REQUIRE(out);
    return out->verdict;
  };
  for (const char* level : {"mandatory", "conditional", "optional", "recommended"}) {
    CHECK(verdict(aborted(0x06090030), level) == Verdict::pass);
    CHECK(verdict(aborted(0x06090031), level) == Verdict::warn);
    CHECK(verdict(aborted(0x06010000), level) == Verdict::fail);
  }
  CHECK(verdict(uploaded({1}), "mandatory") == Verdict::fail);
  CHECK(verdict(uploaded({1}), "conditional") == Verdict::fail);
  CHECK(verdict(uploaded({1}), "optional") == Verdict::warn);
  CHECK(verdict(silent(), "recommended") == Verdict::warn);
  CHECK(verdict(silent(), "recommended", true) == Verdict::fail);
}

TEST_CASE("Without an expectation success is expected, and what is only tolerated warns") {
  FakeSession session;
  auto actual = uploaded({1});
  CHECK(grade({}, actual, "mandatory", false, session)->verdict == Verdict::pass);
  actual.tolerated = {"reserved byte 3 is 01h instead of 00h"};
  const auto out = grade({}, actual, "mandatory", false, session);
  REQUIRE(out);
  CHECK(out->verdict == Verdict::warn);
  CHECK(out->reason == "reserved byte 3 is 01h instead of 00h");
}

}  // namespace
