// SPDX-License-Identifier: Apache-2.0
#include "cli/shell.hpp"

#include <chrono>

#include "catch.hpp"

using namespace conform;
using namespace std::chrono_literals;

TEST_CASE("A command that succeeds is no error, one that fails or takes too long is") {
  CHECK(cli::run_shell("true && exit 0", 10s).has_value());
  const auto failed = cli::run_shell("exit 3", 10s);
  REQUIRE_FALSE(failed.has_value());
  CHECK_THAT(failed.error().what, Catch::Contains("exit code 3"));
  const auto begin = std::chrono::steady_clock::now();
  const auto late = cli::run_shell("cat /dev/zero > /dev/null", 50ms);
  REQUIRE_FALSE(late.has_value());
  CHECK_THAT(late.error().what, Catch::Contains("did not end within 50 ms"));
  CHECK(std::chrono::steady_clock::now() - begin < 5s);
}
