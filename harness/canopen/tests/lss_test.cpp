// SPDX-License-Identifier: Apache-2.0
// Layer setting services: frames as CiA 305 prints them, and the search of a fastscan.
#include "canopen/lss.hpp"

#include "catch.hpp"

using namespace conform;
using namespace conform::canopen;

namespace {

Bytes bytes_of(const can::Frame& frame) { return {frame.bytes().begin(), frame.bytes().end()}; }

/// What a slave of this address answers to a frame of a fastscan.
bool answers(const LssAddress& own, const LssFastscan& asked, std::uint8_t& expected) {
  if (asked.bit_check == LssFastscan::begin) {
    expected = 0;
    return true;
  }
  if (asked.part != expected || (asked.number >> asked.bit_check) != (own[asked.part] >> asked.bit_check))
    return false;
  expected = asked.next;
  return true;
}

}  // namespace

TEST_CASE("LSS requests have eight bytes on 7E5h, numbers least significant byte first") {
  const auto frame = encode_lss(LssCommand::configure_node_id, 0x7F);
  CHECK(frame.id == 0x7E5);
  CHECK(bytes_of(frame) == Bytes{0x11, 0x7F, 0, 0, 0, 0, 0, 0});
  CHECK(bytes_of(encode_lss(LssCommand::configure_bit_timing, 0, 4)) == Bytes{0x13, 0, 4, 0, 0, 0, 0, 0});
  const auto selection = encode_lss_selection({0x12345678, 2, 3, 0x80000001});
  REQUIRE(selection.size() == 4);
  CHECK(bytes_of(selection[0]) == Bytes{0x40, 0x78, 0x56, 0x34, 0x12, 0, 0, 0});
  CHECK(bytes_of(selection[3]) == Bytes{0x43, 1, 0, 0, 0x80, 0, 0, 0});
  CHECK(bytes_of(encode(LssFastscan{0x12345678, 31, 2, 3})) == Bytes{0x51, 0x78, 0x56, 0x34, 0x12, 31, 2, 3});
}

TEST_CASE("LSS answers are data frames on 7E4h, of eight bytes where they are right") {
  const auto answer = decode_lss(can::data_frame(CanId(0x7E4), {0x5B, 1, 3, 0, 0x80, 0, 0, 0}));
  REQUIRE(answer);
  CHECK(answer->specifier == 0x5B);
  CHECK(answer->number == 0x80000301);
  CHECK(answer->reserved_zero);
  CHECK_FALSE(decode_lss(can::data_frame(CanId(0x7E4), {0x11, 0, 0, 1, 0, 0, 0, 0}))->reserved_zero);
  CHECK(answer->eight_bytes);
  CHECK_FALSE(decode_lss(can::data_frame(CanId(0x7E4), {0x44}))->eight_bytes);
  CHECK_FALSE(decode_lss(can::data_frame(CanId(0x7E4), Bytes{})));
  CHECK_FALSE(decode_lss(can::data_frame(CanId(0x7E5), {0x44, 0, 0, 0, 0, 0, 0, 0})));
}

TEST_CASE("LSS error codes are told in words") {
  CHECK(describe_lss_error(0x11, 0, 0) == "0");
  CHECK(describe_lss_error(0x11, 1, 0) == "1 (out of range)");
  CHECK(describe_lss_error(0x17, 2, 0) == "2 (the memory failed)");
  CHECK(describe_lss_error(0x13, 0xFF, 7) == "FFh, of the maker: 07h");
}

TEST_CASE("A fastscan finds the address of the one slave that answers") {
  for (const LssAddress own : {LssAddress{0x5AFE, 0x301, 0x10000, 1}, LssAddress{0, 0, 0, 0},
                               LssAddress{~0U, ~0U, ~0U, ~0U}, LssAddress{0x80000000, 1, 0x7FFFFFFF, 2}}) {
    LssScan scan;
    std::uint8_t expected = 0;
    int frames = 0;
    for (; !scan.finished(); ++frames) scan.answered(answers(own, scan.question(), expected));
    CHECK(scan.found());
    CHECK(scan.address() == own);
    CHECK(frames == 1 + 4 * 33);
  }
}

TEST_CASE("A fastscan of several slaves finds one of them, with nobody there none") {
  const LssAddress one{0x5AFE, 0x301, 0x10000, 9}, other{0x5AFE, 0x301, 0x10000, 6};
  LssScan scan;
  std::uint8_t expected[2] = {0, 0};
  while (!scan.finished()) {
    const auto asked = scan.question();
    const bool first = answers(one, asked, expected[0]), second = answers(other, asked, expected[1]);
    scan.answered(first || second);
  }
  CHECK(scan.found());
  CHECK(scan.address() == other);
  LssScan nobody;
  nobody.answered(false);
  CHECK(nobody.finished());
  CHECK_FALSE(nobody.found());
}
