// SPDX-License-Identifier: Apache-2.0
#include "base/shell_word.hpp"

#include "catch.hpp"

using namespace conform;

TEST_CASE("what means nothing to a shell is not quoted") {
  CHECK(shell_word("--junit=out/r-1.xml") == "--junit=out/r-1.xml");
  CHECK(shell_word("2000h..5FFFh") == "2000h..5FFFh");
  CHECK(shell_word("cia301/sdo/*") == "'cia301/sdo/*'");
  CHECK(shell_word("") == "''");
  CHECK(shell_word("my device's") == "'my device'\\''s'");
  CHECK(shell_word("\x1B[31m") == "$'\\x1b\\x5b31m'");
}
