// SPDX-License-Identifier: Apache-2.0
// How long a classical CAN frame occupies the wire, stuff bits included, and who wins the arbitration.
#pragma once

#include <cstdint>

#include "base/time.hpp"
#include "can/frame.hpp"

namespace conform::can {

/// Recessive bits that separate a frame from the next one (ISO 11898-1, interframe space).
inline constexpr std::uint32_t intermission_bits = 3;

/// CRC-15 of the frame as transmitted in its CRC field (polynomial 4599h).
[[nodiscard]] std::uint16_t frame_crc(const Frame& frame);

/// Bits from start of frame to the last bit of end of frame, with the stuff bits of exactly this content and
/// without the intermission. 44..132 for 11-bit frames, 64..157 for 29-bit frames; 0 for error frames.
[[nodiscard]] std::uint32_t frame_bits(const Frame& frame);

/// The arbitration field as a number: at simultaneous start the frame with the smaller value wins, bit by bit
/// as on the wire (data before remote, 11-bit before 29-bit with the same leading bits).
[[nodiscard]] constexpr std::uint32_t arbitration_key(const Frame& frame) {
  if (!frame.extended) return ((frame.id & 0x7FFU) << 21U) | (frame.remote ? 1U << 20U : 0U);
  const std::uint32_t base = (frame.id >> 18U) & 0x7FFU;
  // SRR and IDE are recessive, then the 18 lower identifier bits, then RTR.
  return (base << 21U) | (3U << 19U) | ((frame.id & 0x3FFFFU) << 1U) | (frame.remote ? 1U : 0U);
}

/// Time of `bits` at `bit_rate` (> 0), rounded to the nearest nanosecond.
[[nodiscard]] constexpr Duration bit_time(std::uint64_t bits, std::uint32_t bit_rate) {
  return Duration((bits * 1'000'000'000U + bit_rate / 2U) / bit_rate);
}

}  // namespace conform::can
