// SPDX-License-Identifier: Apache-2.0
#include "result/worth.hpp"

#include "catch.hpp"

using namespace conform;
using namespace conform::result;
using namespace std::chrono_literals;

namespace {

std::vector<Worth> three() {
  return {{"a/x[1000h:00]", 100ms, 5}, {"a/y", 2s, 3}, {"a/x[1018h:01]", 300ms, 0}};
}

}  // namespace

TEST_CASE("what cases are worth is read as it was written") {
  const auto read = read_worths(worth_file(three()), "worth.json");
  REQUIRE(read);
  REQUIRE(read->cases().size() == 3);
  CHECK(read->cases()[0].name == "a/x[1000h:00]");
  CHECK(read->cases()[0].takes == 100ms);
  CHECK(read->cases()[0].finds == 5);
  CHECK(read->cases()[2].finds == 0);
}

TEST_CASE("a file that does not say what cases are worth is refused with its place") {
  const std::string text =
      GENERATE(R"([])", R"({"canopen_conform_worth":2,"cases":[]})",
               R"({"canopen_conform_worth":1,"cases":[{"case":"a"}]})",
               R"({"canopen_conform_worth":1,"cases":[{"case":"a","ms":-1}]})",
               R"({"canopen_conform_worth":1,"cases":[{"case":"a","ms":9000000000000000000}]})", "{");
  const auto read = read_worths(text, "worth.json");
  REQUIRE_FALSE(read);
  CHECK(read.error().where == "worth.json");
}

TEST_CASE("an object that only this device has takes the place of one that it does not have") {
  const Worths worths(three());
  const std::vector<std::string> names{"a/y", "a/x[2000h:00]", "a/x[1018h:01]", "a/x[2001h:00]", "b/new"};
  CHECK(worths.places(names) == std::vector<std::size_t>{1, 0, 2, 3, 3});
}

TEST_CASE("a case that is not known is expected to take as long as others of its scenario, or as any") {
  const Worths worths(three());
  CHECK(worths.takes("a/x[1000h:00]") == 100ms);
  CHECK(worths.takes("a/x[2000h:00]") == 200ms);
  CHECK(worths.takes("b/new") == 800ms);
  CHECK(Worths().takes("b/new") > 0ms);
}

TEST_CASE("what is still to come is told by how long the cases before took") {
  Pace pace;
  CHECK(pace.of(10s) == 10s);
  pace.took(9s, 19s);
  CHECK(pace.of(10s) == 20s);
}
