// SPDX-License-Identifier: Apache-2.0
#include "cli/run/shell.hpp"

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "catch.hpp"

using namespace conform;
using namespace std::chrono_literals;

namespace {

/// Gone, or a zombie that nobody has asked about yet: the third word of its line in /proc, behind the name.
bool is_over(int process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return true;
  return line[line.rfind(')') + 2] == 'Z';
}

}  // namespace

TEST_CASE("A command that succeeds is no error, one that fails or takes too long is") {
  CHECK(cli::run_shell("true && exit 0", 10s).has_value());
  const auto failed = cli::run_shell("exit 3", 10s);
  REQUIRE_FALSE(failed.has_value());
  CHECK_THAT(failed.error().what, Catch::Contains("exit code 3"));
  const auto killed = cli::run_shell("kill -9 $$", 10s);
  REQUIRE_FALSE(killed.has_value());
  CHECK_THAT(killed.error().what, Catch::Contains("killed by signal 9"));
  const auto begin = std::chrono::steady_clock::now();
  const auto late = cli::run_shell("cat /dev/zero > /dev/null", 50ms);
  REQUIRE_FALSE(late.has_value());
  CHECK_THAT(late.error().what, Catch::Contains("did not end within 50 ms"));
  CHECK(std::chrono::steady_clock::now() - begin < 5s);
}

TEST_CASE("A command that takes too long is killed with everything that it started") {
  const auto file = std::filesystem::temp_directory_path() / ("shell-test-" + std::to_string(::getpid()));
  const auto late = cli::run_shell(
      "cat /dev/zero > /dev/null & echo $! > " + file.string() + "; trap '' TERM; cat /dev/zero > /dev/null",
      500ms);
  CHECK_FALSE(late.has_value());
  int process = 0;
  std::ifstream(file) >> process;
  REQUIRE(process > 0);
  const auto begin = std::chrono::steady_clock::now();
  while (!is_over(process) && std::chrono::steady_clock::now() - begin < 10s) {
  }
  CHECK(is_over(process));
  std::filesystem::remove(file);
}

TEST_CASE("What a command leaves in the background does not hold the run") {
  const auto begin = std::chrono::steady_clock::now();
  CHECK(cli::run_shell("sleep 20 > /dev/null 2>&1 &", 15s).has_value());
  CHECK(std::chrono::steady_clock::now() - begin < 10s);
}
