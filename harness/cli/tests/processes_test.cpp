// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/processes.hpp"

#include <atomic>
#include <csignal>
#include <stdexcept>

#include "base/sanitizer.hpp"
#include "catch.hpp"

using namespace conform::cli;
using Kind = Ending::Kind;

TEST_CASE("what works return comes back in their order, however many run at a time") {
  for (const unsigned jobs : {1U, 3U}) {
    std::size_t ended = 0;
    const auto endings = in_processes(
        7, jobs, {}, [](std::size_t i) { return std::string(i * 20'000, 'x'); },
        [&](std::size_t) { ++ended; });
    REQUIRE(endings.size() == 7);
    CHECK(ended == 7);
    for (std::size_t i = 0; i < endings.size(); ++i) {
      CHECK(endings[i].kind == Kind::returned);
      CHECK(endings[i].text.size() == i * 20'000);
    }
  }
}

TEST_CASE("a crash, an exception, an endless loop and endless memory are told apart") {
  const ProcessLimits limits{.seconds = 1, .memory = 1UL << 28U};
  const auto endings = in_processes(5, 2, limits, [](std::size_t i) -> std::string {
    if (i == 0) std::raise(SIGSEGV);
    if (i == 1) throw std::out_of_range("too far");
    if (i == 2) {
      // An endless loop must do something, or the compiler may leave it out.
      for (std::atomic<unsigned> turns = 0;;) ++turns;
    }
    if (i == 3) return std::string(1UL << 40U, 'x');
    return "well";
  });
  CHECK(endings[0].kind == Kind::crashed);
  CHECK(endings[0].text == "SIGSEGV");
  CHECK(endings[1].kind == Kind::crashed);
  CHECK(endings[1].text == "exception: too far");
  CHECK(endings[2].kind == Kind::hung);
  // AddressSanitizer ends a process that asks for so much before anybody can catch it.
  CHECK(endings[3].kind == (conform::address_sanitizer ? Kind::crashed : Kind::out_of_memory));
  CHECK(endings[4].kind == Kind::returned);
  CHECK(endings[4].text == "well");
}
