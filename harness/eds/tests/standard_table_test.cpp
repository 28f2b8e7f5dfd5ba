// SPDX-License-Identifier: Apache-2.0
#include "eds/standard_table.hpp"

#include "catch.hpp"

namespace {

using namespace conform;
using namespace conform::eds;

TEST_CASE("The table of CiA 301 has a row for what it defines and none for the rest") {
  const auto row = [](std::uint16_t index, std::uint8_t sub) {
    return find_standard_row({Index(index), SubIndex(sub)});
  };
  REQUIRE(row(0x1017, 0) != nullptr);
  CHECK(row(0x1017, 0)->type == 0x06);
  CHECK(row(0x1017, 1) == nullptr);
  CHECK(row(0x1018, 5) == nullptr);
  CHECK(row(0x2000, 0) == nullptr);
  REQUIRE(row(0x15FF, 2) != nullptr);
  CHECK(row(0x15FF, 2)->has(StandardFlag::leaves_access));
  CHECK(rows_of(Index(0x1018)).size() == 5);
  CHECK(rows_of(Index(0x1004)).empty());
  std::uint16_t last = 0;
  for (const auto& each : standard_rows()) {
    CHECK(each.first_index <= each.last_index);
    CHECK(each.first_sub <= each.last_sub);
    CHECK((each.first_index >= last || each.first_index >= 0x1400));
    last = each.first_index;
  }
}

}  // namespace
