// SPDX-License-Identifier: Apache-2.0
#include "base/in_parallel.hpp"

#include <atomic>
#include <new>
#include <stdexcept>
#include <string>

#include "catch.hpp"

namespace {

using namespace conform;

TEST_CASE("Every piece of work is done once, on as many threads as there are to be") {
  for (const unsigned jobs : {0U, 1U, 3U, 64U}) {
    std::vector<std::atomic<int>> done(50);
    in_parallel(done.size(), jobs, [&](std::size_t i) { ++done[i]; });
    for (const auto& each : done) CHECK(each == 1);
  }
  in_parallel(0, 2, [](std::size_t) { FAIL("there is nothing to do"); });
}

TEST_CASE("What one piece of work throws reaches the caller, whichever thread it was on") {
  for (const unsigned jobs : {1U, 4U}) {
    for (const std::size_t which : {std::size_t{0}, std::size_t{7}, std::size_t{49}}) {
      CHECK_THROWS_AS(in_parallel(50, jobs,
                                  [&](std::size_t i) {
                                    if (i == which) throw std::bad_alloc();
                                  }),
                      std::bad_alloc);
    }
    CHECK_THROWS_AS(in_parallel(50, jobs, [](std::size_t) { throw std::runtime_error("all of them"); }),
                    std::runtime_error);
  }
}

TEST_CASE("The first error of all pieces is the result, or all values in their order") {
  const auto squares = all_in_parallel(5, 2, [](std::size_t i) -> Result<std::size_t> { return i * i; });
  REQUIRE(squares);
  CHECK(*squares == std::vector<std::size_t>{0, 1, 4, 9, 16});
  const auto failed = all_in_parallel(5, 2, [](std::size_t i) -> Result<std::size_t> {
    if (i >= 3) return fail("number " + std::to_string(i), "", "");
    return i;
  });
  REQUIRE_FALSE(failed);
  CHECK(failed.error().what == "number 3");
}

}  // namespace
