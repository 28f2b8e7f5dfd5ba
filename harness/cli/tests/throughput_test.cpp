// SPDX-License-Identifier: Apache-2.0
// In virtual time throughput depends on no machine: what keeps the bus idle is a mistake.
#include "cli/proof/throughput.hpp"
#include "catch.hpp"

using namespace conform;
using namespace conform::cli;

namespace {

// 111 bits without any stuff bit, 135 with all there can be, of a frame with eight bytes and its
// intermission.
void is_between_the_limits(const Throughput& got, std::uint32_t bit_rate) {
  const auto frames = static_cast<double>(got.frames);
  const auto bits = std::chrono::duration<double>(got.busy).count() * bit_rate;
  CHECK(bits >= frames * 111);
  CHECK(bits <= frames * 135);
}

}  // namespace

TEST_CASE("A block download keeps the bus at least 95 % busy") {
  for (const std::uint32_t bit_rate : {125'000U, 1'000'000U}) {
    CAPTURE(bit_rate);
    const auto got = measure_simulated(TransferKind::block_download, bit_rate, 100'000);
    REQUIRE(got.has_value());
    CHECK(got->share_of_limit() >= 0.95);
    CHECK(got->share_of_limit() <= 1.0);
    is_between_the_limits(*got, bit_rate);
    // 14286 segments in 113 sub-blocks, each acknowledged; two requests with their answers.
    CHECK(got->frames == 14286 + 113 + 4);
  }
}

TEST_CASE("A block upload keeps the bus at least 95 % busy") {
  for (const std::uint32_t bit_rate : {125'000U, 1'000'000U}) {
    CAPTURE(bit_rate);
    const auto got = measure_simulated(TransferKind::block_upload, bit_rate, 100'000);
    REQUIRE(got.has_value());
    CHECK(got->share_of_limit() >= 0.95);
    CHECK(got->share_of_limit() <= 1.0);
    is_between_the_limits(*got, bit_rate);
    // Initiate, answer, start, end and its confirmation.
    CHECK(got->frames == 14286 + 113 + 5);
  }
}

TEST_CASE("Segmented transfers need two frames for seven bytes") {
  for (const auto kind : {TransferKind::segmented_upload, TransferKind::segmented_download}) {
    const auto got = measure_simulated(kind, 125'000, 7000);
    REQUIRE(got.has_value());
    CHECK(got->frames == 2 * 1000 + 2);
    CHECK(got->share_of_limit() >= 0.85);
    CHECK(got->share_of_limit() <= 1.0);
  }
}

TEST_CASE("Expedited transfers need two frames") {
  for (const auto kind : {TransferKind::expedited_upload, TransferKind::expedited_download}) {
    const auto got = measure_simulated(kind, 125'000, 500);
    REQUIRE(got.has_value());
    CHECK(got->frames == 2 * 500);
    CHECK(got->transfers == 500);
    CHECK(got->share_of_limit() >= 0.85);
  }
}
