// SPDX-License-Identifier: Apache-2.0
// Frame lengths against numbers counted bit by bit elsewhere, and against a deliberately slow second
// implementation.
#include "can/frame_time.hpp"

#include <vector>

#include "catch.hpp"

using namespace conform;
using namespace conform::can;

namespace {

Frame with(std::uint32_t id, std::vector<std::uint8_t> bytes, bool extended = false) {
  Frame frame;
  frame.id = id;
  frame.extended = extended;
  frame.dlc = static_cast<std::uint8_t>(bytes.size());
  std::ranges::copy(bytes, frame.data.begin());
  return frame;
}

// One bit at a time, straight from the frame format of ISO 11898-1.
struct Slow {
  std::uint32_t crc = 0;
  std::uint32_t bits = 0;

  explicit Slow(const Frame& frame) {
    std::vector<std::uint32_t> wire{0};
    const auto put = [&wire](std::uint32_t value, int count) {
      for (int i = count; i-- > 0;) wire.push_back((value >> static_cast<unsigned>(i)) & 1U);
    };
    if (frame.extended) {
      put(frame.id >> 18U, 11);
      put(3, 2);
      put(frame.id, 18);
      put(frame.remote ? 1 : 0, 1);
      put(0, 2);
    } else {
      put(frame.id, 11);
      put(frame.remote ? 1 : 0, 1);
      put(0, 2);
    }
    put(frame.dlc, 4);
    for (const auto byte : frame.bytes()) put(byte, 8);
    for (const auto bit : wire) {
      const bool invert = (bit ^ (crc >> 14U)) != 0;
      crc = (crc << 1U) & 0x7FFFU;
      if (invert) crc ^= 0x4599U;
    }
    put(crc, 15);
    std::uint32_t last = 2;
    std::uint32_t run = 0;
    for (const auto bit : wire) {
      run = bit == last ? run + 1 : 1;
      last = bit;
      ++bits;
      if (run == 5) {
        ++bits;
        last = 1 - bit;
        run = 1;
      }
    }
    bits += 10;
  }
};

}  // namespace

TEST_CASE("frame lengths are the literal ones") {
  CHECK(frame_bits(with(0x000, {})) == 50);
  CHECK(frame_bits(with(0x080, {})) == 48);
  CHECK(frame_bits(with(0x7FF, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF})) == 123);
  CHECK(frame_bits(with(0x605, {0x40, 0x00, 0x10, 0x00, 0, 0, 0, 0})) == 121);
  CHECK(frame_bits(with(0x585, {0x43, 0x00, 0x10, 0x00, 0x91, 0x01, 0x0F, 0x00})) == 115);
  CHECK(frame_bits(remote_frame(CanId(0x701), 1)) == 48);
  CHECK(frame_bits(with(0x555, {0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55})) == 109);
  CHECK(frame_bits(with(0x12345678, {1, 2, 3, 4, 5, 6, 7, 8}, true)) == 137);
  CHECK(frame_bits(with(0, {}, true)) == 71);
}

TEST_CASE("the CRC sequence is the literal one") {
  CHECK(frame_crc(with(0x080, {})) == 0x1C05);
  CHECK(frame_crc(with(0x585, {0x43, 0x00, 0x10, 0x00, 0x91, 0x01, 0x0F, 0x00})) == 0x0D8A);
  CHECK(frame_crc(with(0x12345678, {1, 2, 3, 4, 5, 6, 7, 8}, true)) == 0x221A);
}

TEST_CASE("a data length code above eight still means eight bytes, and its bits count") {
  Frame frame = with(0x123, {0xAA, 0xAA, 0xAA, 0xAA, 0xAA, 0xAA, 0xAA, 0xAA});
  frame.dlc = 15;
  CHECK(frame_bits(frame) == 109);
  CHECK(frame_crc(frame) == 0x16B6);
}

TEST_CASE("an error frame never occupies the wire") {
  Frame frame;
  frame.error = true;
  CHECK(frame_bits(frame) == 0);
}

TEST_CASE("table and bit-by-bit computation agree on many frames") {
  std::uint64_t state = 42;
  const auto next = [&state] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return state >> 33U;
  };
  for (int i = 0; i < 20000; ++i) {
    Frame frame;
    frame.extended = (next() & 1U) != 0;
    frame.id = static_cast<std::uint32_t>(next()) & (frame.extended ? 0x1FFFFFFFU : 0x7FFU);
    frame.remote = (next() & 7U) == 0;
    frame.dlc = static_cast<std::uint8_t>(next() & 0xFU);
    // Long runs are what stuffing is about.
    for (auto& byte : frame.data) {
      const auto kind = next() & 3U;
      byte = kind == 0 ? std::uint8_t{0} : kind == 1 ? std::uint8_t{0xFF} : static_cast<std::uint8_t>(next());
    }
    const Slow slow(frame);
    REQUIRE(frame_crc(frame) == slow.crc);
    REQUIRE(frame_bits(frame) == slow.bits);
  }
}

TEST_CASE("arbitration prefers low identifiers, data over remote and 11 bit over 29 bit") {
  const Frame data = with(0x123, {});
  const Frame remote = remote_frame(CanId(0x123), 0);
  const Frame extended = with(0x123U << 18U, {}, true);
  Frame extended_remote = extended;
  extended_remote.remote = true;
  CHECK(arbitration_key(data) < arbitration_key(remote));
  CHECK(arbitration_key(remote) < arbitration_key(extended));
  CHECK(arbitration_key(extended) < arbitration_key(extended_remote));
  CHECK(arbitration_key(extended_remote) < arbitration_key(with(0x124, {})));
  CHECK(arbitration_key(with((0x122U << 18U) | 0x3FFFFU, {}, true)) < arbitration_key(data));
}

TEST_CASE("bit times are exact for the usual bit rates") {
  CHECK(bit_time(111, 1'000'000) == Duration(111'000));
  CHECK(bit_time(111, 800'000) == Duration(138'750));
  CHECK(bit_time(111, 500'000) == Duration(222'000));
  CHECK(bit_time(111, 10'000) == Duration(11'100'000));
  CHECK(bit_time(1, 83'333) == Duration(12'000));
}
