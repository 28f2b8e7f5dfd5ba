// SPDX-License-Identifier: Apache-2.0
// Queries: what they select without a device, and what they leave to it.
#include "scenario/query.hpp"

#include "catch.hpp"

namespace {

using conform::scenario::Query;

TEST_CASE("A query that asks how much an entry holds leaves that to the device") {
  const auto query = Query::parse("entries with readable and holding 15.. bytes and not changing");
  REQUIRE(query.has_value());
  REQUIRE(query->holding().has_value());
  CHECK(query->holding()->least == 15);
  CHECK(query->holding()->most == ~std::uint64_t{0});
}

TEST_CASE("A query may ask for an exact number of bytes") {
  const auto query = Query::parse("entries with holding 0 bytes");
  REQUIRE(query.has_value());
  REQUIRE(query->holding().has_value());
  CHECK(query->holding()->most == 0);
}

TEST_CASE("A query that does not say how many bytes an entry holds is refused") {
  for (const char* text :
       {"entries with holding bytes", "entries with holding 9..3 bytes", "entries with holding 4"}) {
    const auto query = Query::parse(text);
    REQUIRE_FALSE(query.has_value());
    CHECK(query.error().what.find("holding") != std::string::npos);
  }
}

TEST_CASE("A query without the question has no answer to it") {
  const auto query = Query::parse("entries with readable");
  REQUIRE(query.has_value());
  CHECK_FALSE(query->holding().has_value());
}

}  // namespace
