// SPDX-License-Identifier: Apache-2.0
// The node as a whole: creation, boot-up, and the defects as a list.
#include <set>
#include <string>

#include "defects/defect.hpp"
#include "node/tests/bench.hpp"

using namespace refnode;
using namespace refnode::testing;

TEST_CASE("A node announces itself with one boot-up message and serves SDO afterwards") {
  Bench bench;
  CHECK(bench.send("605: 40 00 10 00 00 00 00 00").empty());
  CHECK(bench.wait(1s) == Frames{"705: 00"});
  CHECK(bench.sdo("40 00 10 00 00 00 00 00") == "43 00 10 00 91 01 0F 00");
  CHECK(bench.sdo("40 01 10 00 00 00 00 00") == "4F 01 10 00 00 00 00 00");
}

TEST_CASE("A node refuses impossible options with a hint") {
  CHECK_FALSE(Node::create({0, {}, {}, {}}).has_value());
  CHECK_FALSE(Node::create({128, {}, {}, {}}).has_value());
  const auto unknown = Node::create({5, {"1003-nonzero-write-acepted"}, {}, {}});
  REQUIRE_FALSE(unknown.has_value());
  CHECK(unknown.error().hint == "did you mean '1003-nonzero-write-accepted'?");
  CHECK_FALSE(Node::create({5, {"1003-oldest-first", "1003-oldest-first"}, {}, {}}).has_value());
}

TEST_CASE("Every defect has a unique id, names requirements, and makes a node that boots") {
  std::set<std::string_view> ids;
  for (const Defect& row : defects()) {
    INFO(row.id);
    CHECK(ids.insert(row.id).second);
    CHECK_FALSE(row.summary.empty());
    CHECK_FALSE(row.violates.empty());
    CHECK(std::set<std::string_view>(row.violates.begin(), row.violates.end()).size() == row.violates.size());
    CHECK(row.id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string_view::npos);
    const auto node = Node::create({5, {std::string(row.id)}, {}, {}});
    CHECK(node.has_value());
  }
}

TEST_CASE("The first defect is visible on the bus and absent from a conformant node") {
  Bench good;
  Bench bad({"1003-nonzero-write-accepted"});
  good.wait(100ms);
  bad.wait(100ms);
  CHECK(good.sdo("2F 03 10 00 01 00 00 00") == "80 03 10 00 30 00 09 06");
  CHECK(bad.sdo("2F 03 10 00 01 00 00 00") == "60 03 10 00 00 00 00 00");
}
