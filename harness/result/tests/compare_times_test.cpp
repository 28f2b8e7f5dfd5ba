// SPDX-License-Identifier: Apache-2.0
#include "result/compare_times.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <random>

#include "catch.hpp"

using namespace conform;
using namespace conform::result;
using std::chrono::microseconds;
using std::chrono::milliseconds;

namespace {

std::vector<Duration> times(std::initializer_list<int> list) {
  std::vector<Duration> out;
  for (const int each : list) out.emplace_back(each);
  return out;
}

/// A bell of this width around `middle`.
Measurement series(const std::string& kind, Duration middle, Duration width, std::uint64_t seed,
                   std::optional<Duration> nominal = {}, std::size_t count = 200) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> bell(0.0, 1.0);
  Measurement out;
  out.kind = kind;
  out.of = "it";
  out.nominal = nominal;
  out.count = count;
  for (std::size_t i = 0; i < count; ++i) {
    const auto off = static_cast<Duration::rep>(bell(random) * static_cast<double>(width.count()));
    out.samples.push_back({BusTime{}, std::max(Duration(0), middle + Duration(off))});
  }
  return out;
}

std::vector<TimesChange> between(Measurement before, Measurement after) {
  RunResult old, now;
  old.measurements = {std::move(before)};
  now.measurements = {std::move(after)};
  return times_changes(old, now);
}

}  // namespace

TEST_CASE("the rank test gives what the tables give") {
  // R: wilcox.test(c(1,2,3,4,5), c(6,7,8,9,10), exact = FALSE): U = 0, p = 0.01219
  const auto apart = rank_test(times({1, 2, 3, 4, 5}), times({6, 7, 8, 9, 10}));
  CHECK(apart.longer == 1.0);
  CHECK(std::abs(apart.p - 0.01219) < 1e-5);
  // With ties, by the definition: 16 pairs, of which 10 are greater and 4 tie.
  const auto ties = rank_test(times({1, 2, 2, 3}), times({2, 2, 4, 5}));
  CHECK(ties.longer == 12.0 / 16);
}

TEST_CASE("what is all the same, or not there, is no evidence") {
  CHECK(rank_test(times({5, 5, 5}), times({5, 5, 5})).p == 1.0);
  CHECK(rank_test({}, times({1})).p == 1.0);
}

TEST_CASE("slower answers are told, with how sure that is") {
  const auto changes = between(series("SDO answer", milliseconds(2), microseconds(300), 1),
                               series("SDO answer", milliseconds(5), microseconds(300), 2));
  REQUIRE(changes.size() == 1);
  CHECK(changes[0].of.empty());  // of all of them, told once
  CHECK(changes[0].longer > 0.99);
  CHECK(changes[0].p < 1e-9);
}

TEST_CASE("a busy host makes no other device of it") {
  CHECK(between(series("SDO answer", microseconds(200), microseconds(40), 1),
                series("SDO answer", microseconds(700), microseconds(300), 2))
            .empty());
  CHECK(between(series("heartbeat", milliseconds(100), microseconds(50), 1, milliseconds(100)),
                series("heartbeat", milliseconds(100), microseconds(2000), 2, milliseconds(100)))
            .empty());
  CHECK(between(series("boot-up", milliseconds(300), milliseconds(5), 1),
                series("boot-up", milliseconds(320), milliseconds(20), 2))
            .empty());
}

TEST_CASE("a few samples are not enough to be sure") {
  CHECK(between(series("SDO answer", milliseconds(2), microseconds(300), 1, {}, 4),
                series("SDO answer", milliseconds(5), microseconds(300), 2, {}, 4))
            .empty());
}

TEST_CASE("a period that drifts is told, and one that scatters") {
  const auto drift = between(series("heartbeat", milliseconds(100), microseconds(200), 1, milliseconds(100)),
                             series("heartbeat", milliseconds(104), microseconds(200), 2, milliseconds(100)));
  REQUIRE(drift.size() == 1);
  CHECK_FALSE(drift[0].is_spread);
  const auto scatter =
      between(series("heartbeat", milliseconds(100), microseconds(200), 1, milliseconds(100)),
              series("heartbeat", milliseconds(100), milliseconds(8), 2, milliseconds(100)));
  REQUIRE(scatter.size() == 1);
  CHECK(scatter[0].is_spread);
  CHECK(scatter[0].after > scatter[0].before);
}

TEST_CASE("what a scenario makes come has no period to compare") {
  CHECK(between(series("TPDO", milliseconds(50), milliseconds(1), 1),
                series("TPDO", milliseconds(150), milliseconds(1), 2))
            .empty());
}

TEST_CASE("a hundred comparisons of the same device find nothing") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    CHECK(between(series("heartbeat", milliseconds(100), milliseconds(1), 2 * seed, milliseconds(100)),
                  series("heartbeat", milliseconds(100), milliseconds(1), 2 * seed + 1, milliseconds(100)))
              .empty());
  }
}
