// SPDX-License-Identifier: Apache-2.0
#include "can/frame_time.hpp"

#include <array>
#include <cstddef>

namespace conform::can {
namespace {

constexpr std::uint32_t crc_polynomial = 0x4599;

// Fields behind the CRC sequence that are never stuffed: CRC delimiter, ACK slot, ACK delimiter, seven bits
// EOF.
constexpr std::uint32_t fixed_tail_bits = 10;

// CRC-15 over eight bits at a time.
constexpr auto crc_table = [] {
  std::array<std::uint16_t, 256> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte << 7U;
    for (int bit = 0; bit < 8; ++bit) {
      const bool top = (crc & 0x4000U) != 0;
      crc = (crc << 1U) & 0x7FFFU;
      if (top) crc ^= crc_polynomial;
    }
    table[byte] = static_cast<std::uint16_t>(crc);
  }
  return table;
}();

// Bit stuffing as an automaton. A state is the last level and the length of its run: (run - 1) * 2 + level
// with run 1..4; a fifth equal bit is followed at once by its stuff bit, which starts a run of one of the
// other level. An entry holds the next state in bits 0..2 and the number of stuff bits (0..2) in bits 4..5.
struct StuffTable {
  std::array<std::array<std::uint8_t, 256>, 8> step{};
};

constexpr StuffTable stuff_table = [] {
  StuffTable table;
  for (std::uint32_t state = 0; state < 8; ++state) {
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::uint32_t level = state & 1U;
      std::uint32_t run = state / 2U + 1U;
      std::uint32_t stuffed = 0;
      for (std::uint32_t i = 8; i-- > 0;) {
        const std::uint32_t bit = (byte >> i) & 1U;
        run = bit == level ? run + 1U : 1U;
        level = bit;
        if (run == 5U) {
          ++stuffed;
          level ^= 1U;
          run = 1U;
        }
      }
      table.step[state][byte] = static_cast<std::uint8_t>((stuffed << 4U) | ((run - 1U) * 2U + level));
    }
  }
  return table;
}();

constexpr std::uint16_t crc_step(std::uint16_t crc, std::uint32_t byte) {
  return static_cast<std::uint16_t>(((static_cast<std::uint32_t>(crc) << 8U) & 0x7FFFU) ^
                                    crc_table[((crc >> 7U) ^ byte) & 0xFFU]);
}

// Everything from start of frame to the DLC, right-aligned in whole bytes.
struct Header {
  std::uint64_t bits;
  std::uint32_t count;  // 19 or 39
};

constexpr Header header_of(const Frame& frame) {
  const std::uint64_t dlc = frame.dlc & 0xFU;
  const std::uint64_t remote = frame.remote ? 1U : 0U;
  if (!frame.extended) {
    // SOF 0, ID 11, RTR, IDE 0, r0 0, DLC 4
    return {(static_cast<std::uint64_t>(frame.id & 0x7FFU) << 7U) | (remote << 6U) | dlc, 19};
  }
  // SOF 0, ID 11, SRR 1, IDE 1, ID 18, RTR, r1 0, r0 0, DLC 4
  const std::uint64_t base = (frame.id >> 18U) & 0x7FFU;
  const std::uint64_t rest = frame.id & 0x3FFFFU;
  return {(base << 27U) | (3ULL << 25U) | (rest << 7U) | (remote << 6U) | dlc, 39};
}

constexpr std::uint16_t crc_of(const Frame& frame, const Header& header, std::size_t size) {
  std::uint16_t crc = 0;
  // The bits that fill the header up to whole bytes are leading zeros, which leave a zero CRC alone.
  for (std::uint32_t shift = header.count == 19 ? 24 : 40; shift > 0; shift -= 8) {
    crc = crc_step(crc, static_cast<std::uint32_t>(header.bits >> (shift - 8U)) & 0xFFU);
  }
  for (std::size_t i = 0; i < size; ++i) crc = crc_step(crc, frame.data[i]);
  return crc;
}

}  // namespace

std::uint16_t frame_crc(const Frame& frame) { return crc_of(frame, header_of(frame), frame.size()); }

std::uint32_t frame_bits(const Frame& frame) {
  if (frame.error) return 0;
  const Header header = header_of(frame);
  const std::size_t size = frame.size();
  const std::uint16_t crc = crc_of(frame, header, size);

  std::uint32_t state = 0;  // dominant, run 1: the alternating filler below makes it irrelevant
  std::uint32_t stuffed = 0;
  const auto feed = [&](std::uint32_t byte) {
    const std::uint8_t entry = stuff_table.step[state][byte];
    state = entry & 7U;
    stuffed += static_cast<std::uint32_t>(entry >> 4U);
  };
  // The header is filled up in front with 1,0,1,... ending in 1, so that the dominant start bit begins a new
  // run: 19 bits + 10101, 39 bits + 1.
  if (header.count == 19) {
    const std::uint64_t bits = header.bits | (0b10101ULL << 19U);
    feed(static_cast<std::uint32_t>(bits >> 16U) & 0xFFU);
    feed(static_cast<std::uint32_t>(bits >> 8U) & 0xFFU);
    feed(static_cast<std::uint32_t>(bits) & 0xFFU);
  } else {
    const std::uint64_t bits = header.bits | (1ULL << 39U);
    for (std::uint32_t shift = 40; shift > 0; shift -= 8) {
      feed(static_cast<std::uint32_t>(bits >> (shift - 8U)) & 0xFFU);
    }
  }
  for (std::size_t i = 0; i < size; ++i) feed(frame.data[i]);
  // Behind the 15 CRC bits one bit is missing to a whole byte; the complement of the last one adds no stuff
  // bit.
  const std::uint32_t tail = (static_cast<std::uint32_t>(crc) << 1U) | ((crc & 1U) ^ 1U);
  feed((tail >> 8U) & 0xFFU);
  feed(tail & 0xFFU);

  return header.count + static_cast<std::uint32_t>(size) * 8U + 15U + stuffed + fixed_tail_bits;
}

}  // namespace conform::can
