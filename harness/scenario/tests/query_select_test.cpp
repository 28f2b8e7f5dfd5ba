// SPDX-License-Identifier: Apache-2.0
// Queries over a small dictionary: every clause, their joining, and mistakes.
#include "base/text.hpp"

#include "catch.hpp"
#include "scenario/query.hpp"

namespace {

using namespace conform;
using device::Access;
using device::Entry;
using scenario::Query;

Entry entry(std::uint16_t index, std::uint8_t sub, canopen::DataType type, Access access) {
  Entry out;
  out.mux = {Index(index), SubIndex(sub)};
  out.type = type;
  out.access = access;
  return out;
}

device::Dictionary dictionary() {
  using canopen::DataType;
  device::Dictionary out;
  auto type = entry(0x1000, 0, DataType::unsigned32, Access::ro);
  type.category = device::Category::mandatory;
  out.add(type);
  out.add(entry(0x1008, 0, DataType::visible_string, Access::constant));
  for (const std::uint8_t sub : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{2}}) {
    auto pdo = entry(0x1400, sub, sub == 1 ? DataType::unsigned32 : DataType::unsigned8, Access::rw);
    pdo.object = device::ObjectCode::record;
    out.add(pdo);
  }
  out.add(entry(0x1800, 0, DataType::unsigned8, Access::constant));
  auto limited = entry(0x2000, 0, DataType::integer16, Access::rww);
  limited.low = Bytes{0x00, 0x80};
  limited.high = Bytes{0xFF, 0x00};
  limited.default_value = Bytes{0, 0};
  limited.declared_default = limited.claimed = limited.pdo_mappable = limited.may_change = limited.safe =
      true;
  out.add(limited);
  auto domain = entry(0x2001, 0, DataType::domain, Access::wo);
  domain.command = true;
  out.add(domain);
  auto array = entry(0x2002, 1, DataType::unsigned8, Access::rw);
  array.object = device::ObjectCode::array;
  array.access_open = true;
  out.add(array);
  return out;
}

std::string selected(std::string_view text) {
  const auto query = Query::parse(text);
  REQUIRE(query);
  std::string out;
  for (const auto mux : query->select(dictionary())) out += (out.empty() ? "" : " ") + to_string(mux);
  return out;
}

std::string refusal(std::string_view text) {
  const auto query = Query::parse(text);
  REQUIRE_FALSE(query);
  return query.error().text();
}

TEST_CASE("Entries come in the order of the dictionary, objects once each") {
  CHECK(selected("entries with index 1400h..1800h") == "1400h:00 1400h:01 1400h:02 1800h:00");
  CHECK(selected("objects with index 1000h..1800h") == "1000h:00 1008h:00 1400h:00 1800h:00");
  CHECK(selected("rpdos") == "1400h:00");
  CHECK(selected("tpdos") == "1800h:00");
  CHECK(selected("rpdos with access ro").empty());
}

TEST_CASE("Clauses on access, type and size select by the description") {
  CHECK(selected("entries with access ro or const") == "1000h:00 1008h:00 1800h:00");
  CHECK(selected("entries with not readable") == "2001h:00");
  CHECK(selected("entries with not writable and not size 4") == "1008h:00 1800h:00");
  CHECK(selected("entries with type VISIBLE_STRING") == "1008h:00");
  CHECK(selected("entries with size 2..4") == "1000h:00 1400h:01 2000h:00");
  CHECK(selected("entries with size 3..") == selected("entries with size 4..8"));
  CHECK(selected("entries with index 2001h..") == "2001h:00 2002h:01");
  CHECK(selected("entries with not fixed size") == "1008h:00 2001h:00");
  CHECK(selected("entries with domain") == "2001h:00");
  CHECK(selected("entries with integer and index 2000h..2FFFh") == "2000h:00 2002h:01");
  CHECK(selected("entries with open access") == "2002h:01");
}

TEST_CASE("Clauses on limits know whether the type leaves room beyond them") {
  CHECK(selected("entries with limits") == "2000h:00");
  CHECK(selected("entries with low limit and high limit") == "2000h:00");
  CHECK(selected("entries with high limit below type maximum") == "2000h:00");
  // 8000h is the least an INTEGER16 holds: nothing is below it.
  CHECK(selected("entries with low limit above type minimum").empty());
  CHECK(selected("entries with default") == "2000h:00");
  CHECK(selected("entries with declared default") == "2000h:00");
}

TEST_CASE("A full range is one of which no limit leaves out a value, whether limits are declared or not") {
  using canopen::DataType;
  device::Dictionary all;
  const auto add = [&all](std::uint16_t index, DataType type, std::optional<Bytes> low,
                          std::optional<Bytes> high) {
    auto out = entry(index, 0, type, Access::rw);
    out.low = std::move(low);
    out.high = std::move(high);
    all.add(out);
  };
  add(0x2000, DataType::unsigned8, Bytes{0}, Bytes{0xFF});
  add(0x2001, DataType::unsigned8, std::nullopt, std::nullopt);
  add(0x2002, DataType::unsigned8, std::nullopt, Bytes{0x0F});
  add(0x2003, DataType::unsigned8, Bytes{1}, std::nullopt);
  add(0x2004, DataType::integer16, Bytes{0x00, 0x80}, Bytes{0xFF, 0x7F});
  add(0x2005, DataType::integer16, std::nullopt, Bytes{0xFF, 0xFF});
  add(0x2006, DataType::real32, std::nullopt, std::nullopt);
  add(0x2007, DataType::real32, Bytes{0, 0, 0, 0}, std::nullopt);
  std::string out;
  for (const auto mux : Query::parse("entries with full range")->select(all)) out += to_string(mux) + " ";
  CHECK(out == "2000h:00 2001h:00 2004h:00 2006h:00 ");
}

TEST_CASE("Clauses on properties of the description select by them") {
  CHECK(selected("entries with mappable") == "2000h:00");
  CHECK(selected("entries with changing") == "2000h:00");
  CHECK(selected("entries with safe") == "2000h:00");
  CHECK(selected("entries with command") == "2001h:00");
  CHECK(selected("entries with claimed") == "1000h:00 2000h:00");
  CHECK(selected("entries with array") == "2002h:01");
  CHECK(selected("entries with complex") == "1400h:00 1400h:01 1400h:02 2002h:01");
  CHECK(selected("entries with element") == "1400h:01 1400h:02 2002h:01");
}

TEST_CASE("A query that cannot be read says which word is wrong") {
  CHECK(refusal("") == "an empty query");
  CHECK(refusal("things") == "a query begins with entries, objects, rpdos or tpdos, not with 'things'");
  CHECK(refusal("entries that are small") == "'with' is due instead of 'that'");
  CHECK(refusal("entries with") == "a property is missing");
  CHECK(refusal("entries with readable and") == "a property is missing");
  CHECK(refusal("entries with not") == "a property is missing");
  CHECK(refusal("entries with readabel") == "unknown property 'readabel' (did you mean 'readable'?)");
  CHECK(refusal("entries with access rx") == "unknown access 'rx' (ro, wo, rw, rwr, rww or const)");
  CHECK(refusal("entries with type UINT8") == "unknown data type 'UINT8'");
  CHECK(refusal("entries with size big") == "'size' needs a number of bytes or a range (size 4, size 2..8)");
  CHECK(refusal("entries with size 8..2") == "'size' needs a number of bytes or a range (size 4, size 2..8)");
  CHECK(refusal("entries with index 5FFFh..2000h") == "'index' needs a range (index 2000h..5FFFh)");
  CHECK(refusal("entries with index 2000h..x") == "'index' needs a range (index 2000h..5FFFh)");
}

TEST_CASE("Thousands of 'not' in a query do not end on the stack") {
  std::string text = "entries with";
  for (int i = 0; i < 200'000; ++i) text += " not";
  CHECK_FALSE(Query::parse(text + " readable"));
}

}  // namespace
