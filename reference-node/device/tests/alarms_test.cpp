// SPDX-License-Identifier: Apache-2.0
#include "device/alarms.hpp"

#include <algorithm>
#include <chrono>
#include <deque>

#include <catch2/catch.hpp>

#include "base/random.hpp"

using conform::BusTime;
using refnode::Alarms;
using namespace std::chrono_literals;

TEST_CASE("Alarms that are not set are never due") {
  Alarms alarms;
  CHECK_FALSE(alarms.next());
  Alarms::Alarm one(alarms);
  CHECK_FALSE(one);
  CHECK_FALSE(alarms.next());
}

TEST_CASE("The earliest alarm is the next one, also when another was put off or taken back") {
  Alarms alarms;
  Alarms::Alarm one(alarms), other(alarms);
  one = BusTime(20ms);
  other = BusTime(30ms);
  CHECK(alarms.next() == BusTime(20ms));
  one = BusTime(40ms);
  CHECK(alarms.next() == BusTime(30ms));
  other.reset();
  CHECK(alarms.next() == BusTime(40ms));
  one.reset();
  CHECK_FALSE(alarms.next());
}

TEST_CASE("Whatever is set and reset in whatever order, the next alarm is the least of all") {
  Alarms alarms;
  std::deque<Alarms::Alarm> some;
  for (int i = 0; i < 7; ++i) some.emplace_back(alarms);
  std::uint64_t seed = 5;
  for (int i = 0; i < 5000; ++i) {
    auto& one = some[conform::next_random(seed) % some.size()];
    if (conform::next_random(seed) % 3 == 0)
      one.reset();
    else
      one = BusTime(std::chrono::milliseconds(conform::next_random(seed) % 50));
    if (conform::next_random(seed) % 2 == 0) continue;  // not asked each time
    std::optional<BusTime> least;
    for (const auto& each : some) {
      if (each && (!least || *each < *least)) least = *each;
    }
    REQUIRE(alarms.next() == least);
  }
}
