// SPDX-License-Identifier: Apache-2.0
// Counters and times of day in a row of frames.
#include "steps/contents.hpp"

#include <chrono>
#include <vector>

#include "catch.hpp"

using namespace conform;
using namespace conform::steps;
using std::chrono::milliseconds;

namespace {

struct Row {
  void add(int at_ms, Bytes data) {
    frames.push_back(
        {can::data_frame(CanId(0x80), data), BusTime(milliseconds(at_ms)), can::Direction::received, {}});
  }
  [[nodiscard]] std::vector<const can::CapturedFrame*> all() const {
    std::vector<const can::CapturedFrame*> out;
    for (const auto& frame : frames) out.push_back(&frame);
    return out;
  }
  std::vector<can::CapturedFrame> frames;
};

Row counting(const std::vector<std::uint8_t>& counts) {
  Row row;
  for (const auto count : counts) row.add(0, {count});
  return row;
}

}  // namespace

TEST_CASE("a counter runs from 1 to the overflow value and begins anew") {
  CHECK(out_of_order(counting({1, 2, 3, 1, 2}).all(), 3) == 0);
  CHECK(out_of_order(counting({3, 1, 2, 3}).all(), 3) == 0);
  CHECK(out_of_order(counting({1, 2, 3, 4, 1}).all(), 3) == 1);
  CHECK(out_of_order(counting({1, 2, 3, 0, 1}).all(), 3) == 1);
  CHECK(out_of_order(counting({1, 2, 1, 2}).all(), 3) == 1);
  CHECK(out_of_order(counting({2, 2}).all(), 3) == 1);
  CHECK(out_of_order(counting({239, 240, 1}).all(), 240) == 0);
}

TEST_CASE("a frame without one byte counts nothing") {
  Row row;
  row.add(0, {1});
  row.add(0, {});
  row.add(0, {2, 0});
  row.add(0, {2});
  CHECK(out_of_order(row.all(), 3) == 2);
  CHECK_FALSE(common_length(row.all()));
  CHECK(common_length(counting({1, 2}).all()) == 1U);
}

TEST_CASE("times of day run as the bus does, over midnight too") {
  Row row;
  row.add(100, {0x00, 0x5C, 0x26, 0x05, 0x10, 0x27});  // 86 400 000: a day has fewer
  row.add(1000, {0xFF, 0x5B, 0x26, 0x05, 0x10, 0x27});
  row.add(2000, {0xE7, 0x03, 0x00, 0x00, 0x11, 0x27});
  row.add(3000, {0xCF, 0x07, 0x00, 0x00, 0x11, 0x27});
  const auto times = times_of_day(row.all());
  CHECK(times.malformed == 1);
  CHECK(times.drift == milliseconds(0));
}

TEST_CASE("a clock that stands still drifts, and reserved bits are no time") {
  Row row;
  row.add(0, {0, 0, 0, 0, 1, 0});
  row.add(1500, {0, 0, 0, 0, 1, 0});
  row.add(2000, {0, 0, 0, 0x10, 1, 0});
  row.add(3000, {0, 0, 0, 0, 1, 0, 0, 0});
  const auto times = times_of_day(row.all());
  CHECK(times.malformed == 2);
  CHECK(times.drift == milliseconds(1500));
}
