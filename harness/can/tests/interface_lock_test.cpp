// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "can/interface_lock.hpp"
#include "catch.hpp"

using namespace conform;

// The loopback interface is there on every machine, and a lock does not care what an interface carries.
TEST_CASE("an interface has one runner at a time, and is free again when that one ends") {
  auto first = can::InterfaceLock::take("lo");
  REQUIRE(first.has_value());
  const auto second = can::InterfaceLock::take("lo");
  REQUIRE_FALSE(second.has_value());
  CHECK(second.error().what == "another canopen-conform runs on this interface");
  {
    const std::optional<can::InterfaceLock> ended(std::move(*first));
  }
  CHECK(can::InterfaceLock::take("lo").has_value());
}

TEST_CASE("an interface that is not there cannot be locked") {
  CHECK(can::InterfaceLock::take("no-such-if").error().what == "there is no such interface");
}
